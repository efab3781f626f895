#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;

namespace {

/// One node, one channel on `path`, keys at 0 and 1 s.
test::GltfBuilder animated(std::string_view path, std::size_t (*add_output)(test::GltfBuilder&),
                           std::string_view interpolation = "LINEAR") {
    auto file = test::one_triangle();
    const auto input = file.add_scalars({0, 1});
    const auto output = add_output(file);
    file.json["animations"] = {
        {{"name", "clip"},
         {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}}}};
    return file;
}

}  // namespace

TEST_CASE("channels and samplers are read", "[load]") {
    const auto scene = animated(
                           "translation",
                           [](auto& file) {
                               return file.add_vec3s({0, 0, 0, 1, 2, 3});
                           },
                           "STEP")
                           .load();
    REQUIRE(scene.animations.size() == 1);
    const auto& animation = scene.animations[0];
    CHECK(animation.name == "clip");
    REQUIRE(animation.channels.size() == 1);
    CHECK(animation.channels[0].object == 0);
    CHECK(animation.channels[0].path == anim::ChannelPath::translation);
    const auto& sampler = animation.samplers.at(animation.channels[0].sampler);
    CHECK(sampler.times_s == std::vector<float>{0, 1});
    CHECK(sampler.values == std::vector<float>{0, 0, 0, 1, 2, 3});
    CHECK(sampler.width == 3);
    CHECK(sampler.interpolation == anim::Interpolation::step);
}

TEST_CASE("rotations may be normalized integers", "[load]") {
    auto file = animated("rotation", [](auto& f) {
        const auto accessor = f.template add_accessor<std::int16_t>({0, 0, 0, 32767, 32767, 0, 0, -32767},
                                                                    test::int16, "VEC4", 2);
        f.json["accessors"][accessor]["normalized"] = true;
        return accessor;
    });
    const auto scene = file.load();
    CHECK(scene.animations[0].samplers[0].values == std::vector<float>{0, 0, 0, 1, 1, 0, 0, -1});
    CHECK(scene.animations[0].samplers[0].width == 4);
}

TEST_CASE("cubic splines keep tangents beside each value", "[load]") {
    const auto scene = animated(
                           "scale",
                           [](auto& file) {
                               return file.add_vec3s({0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0});
                           },
                           "CUBICSPLINE")
                           .load();
    const auto& sampler = scene.animations[0].samplers[0];
    CHECK(sampler.interpolation == anim::Interpolation::cubic_spline);
    CHECK(sampler.width == 3);
    CHECK(sampler.values.size() == 18);
}

TEST_CASE("morph weights have one number per target", "[load]") {
    auto file = animated("weights", [](auto& f) { return f.add_scalars({0, 0.5f, 1, 0.25f}); });
    const auto lift = file.add_vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1});
    file.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", lift}}, {{"POSITION", lift}}};
    const auto scene = file.load();
    CHECK(scene.animations[0].samplers[0].width == 2);
    CHECK(scene.animations[0].channels[0].path == anim::ChannelPath::weights);
}

TEST_CASE("a single key is enough unless it is a spline", "[load]") {
    auto file = animated("translation", [](auto& f) { return f.add_vec3s({1, 2, 3}); });
    file.json["animations"][0]["samplers"][0]["input"] = file.add_scalars({0.5f});
    CHECK(file.load().animations[0].samplers[0].times_s == std::vector<float>{0.5f});
}

TEST_CASE("channels without a node are ignored", "[load]") {
    auto file = animated("translation", [](auto& f) { return f.add_vec3s({0, 0, 0, 1, 2, 3}); });
    auto& channels = file.json["animations"][0]["channels"];
    channels.push_back({{"sampler", 0}, {"target", {{"path", "rotation"}}}});
    const auto scene = file.load();
    CHECK(scene.animations[0].channels.size() == 1);
    CHECK(scene.warnings.empty());
}

TEST_CASE("channels on unknown paths are left out with a warning", "[load]") {
    auto file = animated("translation", [](auto& f) { return f.add_vec3s({0, 0, 0, 1, 2, 3}); });
    auto& channels = file.json["animations"][0]["channels"];
    channels.push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "colour"}}}});
    const auto scene = file.load();
    CHECK(scene.animations[0].channels.size() == 1);
    CHECK_THAT(test::warning_at(scene, "/animations/0"), Contains("colour"));
}

TEST_CASE("samplers that nothing plays are not kept", "[load]") {
    auto file = animated("translation", [](auto& f) { return f.add_vec3s({0, 0, 0, 1, 2, 3}); });
    auto& samplers = file.json["animations"][0]["samplers"];
    samplers.insert(samplers.begin(), samplers[0]);
    file.json["animations"][0]["channels"][0]["sampler"] = 1;
    const auto scene = file.load();
    CHECK(scene.animations[0].samplers.size() == 1);
    CHECK(scene.animations[0].channels[0].sampler == 0);
}
