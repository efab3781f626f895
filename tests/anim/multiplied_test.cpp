// Files in which small things multiply one another: refused, or read in time that grows with their size.
// Where a loop over all pairs comes back, these tests take minutes.

#include "anim/clip_bounds.h"
#include "anim/repeats.h"
#include "gltf_builder.h"
#include "scene_builder.h"

#include <catch2/catch.hpp>

#include <functional>
#include <numeric>
#include <string>
#include <utility>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// As many of one value.
json many(std::size_t count, const json& value) {
    return json(json::array_t(count, value));
}

/// A channel for each of the file's nodes, all of one sampler with a key a second.
void share_sampler(test::GltfBuilder& file, std::size_t keys, std::size_t output,
                   const std::function<json(std::size_t node)>& target) {
    std::vector<float> times(keys);
    std::iota(times.begin(), times.end(), 0.0f);
    json channels = json::array();
    for (std::size_t i = 0; i < file.json["nodes"].size(); ++i)
        channels.push_back({{"sampler", 0}, {"target", target(i)}});
    file.json["animations"] =
        json::array({{{"samplers", json::array({{{"input", file.add_scalars(times)}, {"output", output}}})},
                      {"channels", std::move(channels)}}});
}

json pointer_to(const std::string& pointer) {
    return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
}

}  // namespace

TEST_CASE("as many scenes as nodes are read", "[validate][multiplied]") {
    auto file = test::one_triangle();
    constexpr std::size_t count = 100'000;
    file.json["nodes"] = many(count, json::object());
    file.json["scenes"] = many(count, json::object());
    CHECK(file.load().scenes.size() == count);
}

TEST_CASE("many nodes share a mesh of many primitives and a skin", "[validate][multiplied]") {
    auto file = test::skinned_triangle();
    constexpr std::size_t primitives = 4'000, nodes = 50'000;
    const json primitive = file.json["meshes"][0]["primitives"][0];
    file.json["meshes"][0]["primitives"] = many(primitives, primitive);
    for (std::size_t i = 0; i < nodes; ++i) file.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    CHECK(file.load().nodes.size() == nodes + 3);

    file.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    CHECK_THAT(test::refusal_of(file).message, Contains("primitive 4000 of mesh 0 has no JOINTS_0"));
}

TEST_CASE("more attributes than any vertex has are refused", "[validate][multiplied]") {
    auto file = test::one_triangle();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    for (int i = 0; i < 1023; ++i) attributes["_" + std::to_string(i)] = 0;
    CHECK(test::refusal_of(file).message.empty());
    attributes["_MORE"] = 0;
    const auto refusal = test::refusal_of(file);
    CHECK(refusal.pointer == "/meshes/0/primitives/0/attributes");
    CHECK_THAT(refusal.message, Contains("has 1025 entries; at most 1024 are read"));
}

TEST_CASE("morph weights count as memory for every node that has them", "[validate][multiplied]") {
    auto file = test::one_triangle();
    file.json["meshes"][0]["primitives"][0]["targets"] = many(40'000, json::object());
    CHECK(test::refusal_of(file).message.empty());
    for (int i = 0; i < 20'000; ++i) file.json["nodes"].push_back({{"mesh", 0}});
    const auto refusal = test::refusal_of(file);
    CHECK_THAT(refusal.pointer, Contains("/nodes/"));
    CHECK_THAT(refusal.message, Contains("more memory than a file of this size"));
}

TEST_CASE("objects of three bytes count as the memory that they become", "[validate][multiplied]") {
    auto file = test::one_triangle();
    file.json["nodes"] = many(400'000, json::object());
    CHECK_THAT(test::refusal_of(file).message, Contains("more memory than a file of this size"));
}

TEST_CASE("many channels share a sampler of many keys", "[validate][multiplied]") {
    constexpr std::size_t keys = 200'000, nodes = 20'000;
    std::size_t moving = 0;
    auto file = test::one_triangle();
    file.json["nodes"] = many(nodes, {{"mesh", 0}});
    std::vector<std::size_t> all(nodes);
    std::iota(all.begin(), all.end(), std::size_t{0});
    file.json["scenes"][0]["nodes"] = all;
    SECTION("hiding") {
        share_sampler(file, keys,
                      file.add_accessor(std::vector<float>(keys, 0.0f), test::float32, "SCALAR", keys),
                      [](std::size_t node) {
                          return pointer_to("/nodes/" + std::to_string(node) +
                                            "/extensions/KHR_node_visibility/visible");
                      });
        file.json["animations"][0]["samplers"][0]["interpolation"] = "STEP";
    }
    SECTION("turning") {
        std::vector<float> turns(4 * keys, 0.0f);
        for (std::size_t key = 0; key < keys; ++key) turns[4 * key + 3] = 1.0f;
        share_sampler(file, keys, file.add_vec4s(turns), [](std::size_t node) {
            return json{{"node", node}, {"path", "rotation"}};
        });
    }
    SECTION("moving by next to nothing") {
        std::vector<float> places(3 * keys, 0.0f);
        places[3] = 1.0f;
        places[3 * (keys - 1)] = 1e-6f;
        moving = nodes;
        share_sampler(file, keys, file.add_vec3s(places), [](std::size_t node) {
            return json{{"node", node}, {"path", "translation"}};
        });
    }
    const auto scene = file.load();
    const auto clip = anim::choose_clip(scene);
    CHECK(scene.animations[0].channels.size() == nodes);
    CHECK(anim::repeats(scene, clip, 0.0, clip.duration_s));
    CHECK(anim::lay_out(scene, clip).moving_triangles() == moving);
}

TEST_CASE("many meshes whose weights are driven, and many nodes", "[validate][multiplied]") {
    constexpr std::size_t meshes = 4'000;
    auto file = test::one_triangle();
    file.json["meshes"][0]["primitives"][0]["targets"] = json::array({json::object()});
    file.json["meshes"] = many(meshes, file.json["meshes"][0]);
    file.json["nodes"] = many(meshes, {{"mesh", 0}});
    share_sampler(file, 2, file.add_scalars({0, 1}),
                  [](std::size_t i) { return pointer_to("/meshes/" + std::to_string(i) + "/weights"); });
    for (int i = 0; i < 100'000; ++i) file.json["nodes"].push_back(json::object());
    CHECK(file.load().animations[0].channels.size() == meshes);
}

TEST_CASE("objects with more properties than anything has are refused", "[validate][multiplied]") {
    auto file = test::one_triangle();
    for (int i = 0; i < 1024; ++i) file.json["_" + std::to_string(i)] = 0;
    CHECK_THAT(test::refusal_of(file).message, Contains("at most 1024 are read"));
}

TEST_CASE("a box around very many small parts", "[anim][multiplied]") {
    anim::Scene scene = anim::testing::empty_scene();
    constexpr std::size_t count = 300'000;
    anim::Node crowd;
    crowd.mesh = anim::testing::add_mesh(scene, anim::testing::triangle());
    crowd.instances.resize(count);
    for (std::size_t i = 0; i < count; ++i) crowd.instances[i].translation.x = double(i);
    anim::testing::add_node(scene, crowd);
    CHECK(anim::clip_bounds(scene, anim::choose_clip(scene)).max.x == float(count));
}
