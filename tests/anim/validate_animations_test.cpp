#include "defect.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Node 0 moves and turns; keys at 0 and 1 s. Channel and sampler 0 translate, 1 rotate.
test::GltfBuilder moving_triangle() {
    auto file = test::one_triangle();
    const auto times = file.add_scalars({0, 1});
    const auto moves = file.add_vec3s({0, 0, 0, 1, 0, 0});
    const auto turns = file.add_vec4s({0, 0, 0, 1, 1, 0, 0, 0});
    file.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", moves}}, {{"input", times}, {"output", turns}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
           {{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    return file;
}

json& sampler(test::GltfBuilder& file, std::size_t i) {
    return file.json["animations"][0]["samplers"][i];
}
json& target(test::GltfBuilder& file, std::size_t i) {
    return file.json["animations"][0]["channels"][i]["target"];
}

constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("animations that cannot be played are refused", "[validate]") {
    const test::Defect defects[] = {
        {"times that repeat", "/animations/0/samplers/0/input",
         "key 1 at 0.5 s does not come after key 0 at 0.5 s",
         [](auto& f) {
             sampler(f, 0)["input"] = f.add_scalars({0.5f, 0.5f});
         }},
        {"times that fall", "/animations/0/samplers/0/input", "does not come after",
         [](auto& f) {
             sampler(f, 0)["input"] = f.add_scalars({1, 0});
         }},
        {"negative times", "/animations/0/samplers/0/input", "key 0 is at -1 s",
         [](auto& f) {
             sampler(f, 0)["input"] = f.add_scalars({-1, 0});
         }},
        {"times that are not finite", "/animations/0/samplers/0/input", "key 1 is at inf s",
         [](auto& f) {
             sampler(f, 0)["input"] = f.add_scalars({0, infinity});
         }},
        {"times that are vectors", "/animations/0/samplers/0/input", "SCALAR of FLOAT",
         [](auto& f) { sampler(f, 0)["input"] = 0; }},
        {"times that are integers", "/animations/0/samplers/0/input", "SCALAR of FLOAT",
         [](auto& f) { sampler(f, 0)["input"] = 1; }},
        {"too few values", "/animations/0/samplers/0/output", "1 key values; 2 keys need 2",
         [](auto& f) {
             sampler(f, 0)["output"] = f.add_vec3s({0, 0, 0});
         }},
        {"values without tangents", "/animations/0/samplers/0/output", "2 key values; 2 keys need 6",
         [](auto& f) { sampler(f, 0)["interpolation"] = "CUBICSPLINE"; }},
        {"a spline of one key", "/animations/0/samplers/0/input", "at least two keys",
         [](auto& f) {
             sampler(f, 0) = {{"input", f.add_scalars({0})},
                              {"output", f.add_vec3s(std::vector<float>(9, 0.0f))},
                              {"interpolation", "CUBICSPLINE"}};
         }},
        {"translations of four components", "/animations/0/samplers/1/output", "VEC4; this path needs VEC3",
         [](auto& f) {
             f.json["animations"][0]["channels"] =
                 nlohmann::json::array({f.json["animations"][0]["channels"][1]});
             target(f, 0)["path"] = "translation";
         }},
        {"translations as integers", "/animations/0/samplers/0/output", "this path needs FLOAT",
         [](auto& f) {
             sampler(f, 0)["output"] = f.add_accessor(std::vector<std::int8_t>(6, 0), test::int8, "VEC3", 2);
             f.json["accessors"].back()["normalized"] = true;
         }},
        {"rotations as plain integers", "/animations/0/samplers/1/output", "FLOAT or normalized integers",
         [](auto& f) {
             sampler(f, 1)["output"] = f.add_accessor(std::vector<std::int8_t>(8, 1), test::int8, "VEC4", 2);
         }},
        {"values that are not finite", "/animations/0/samplers/0/output", "a key value is inf",
         [](auto& f) {
             sampler(f, 0)["output"] = f.add_vec3s({0, 0, 0, 0, infinity, 0});
         }},
        {"a rotation of length zero", "/animations/0/samplers/1/output", "rotation of key 1",
         [](auto& f) {
             sampler(f, 1)["output"] = f.add_vec4s({0, 0, 0, 1, 0, 0, 0, 0});
         }},
        {"the same property twice", "/animations/0/channels/1/target", "animated twice",
         [](auto& f) { f.json["animations"][0]["channels"][1] = f.json["animations"][0]["channels"][0]; }},
        {"a node with a matrix", "/animations/0/channels/0/target", "has a matrix",
         [](auto& f) { f.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }},
        {"weights of a mesh without targets", "/animations/0/channels/0/target", "no mesh with morph targets",
         [](auto& f) { target(f, 0)["path"] = "weights"; }},
        {"weights of a node without a mesh", "/animations/0/channels/0/target", "no mesh with morph targets",
         [](auto& f) {
             f.json["nodes"][0].erase("mesh");
             target(f, 0)["path"] = "weights";
         }},
        {"too few weights", "/animations/0/samplers/0/output", "2 key values; 2 keys need 4",
         [](auto& f) {
             f.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
             target(f, 0)["path"] = "weights";
             sampler(f, 0)["output"] = f.add_scalars({0, 1});
         }},
        {"no path", "/animations/0/channels/0/target", "\"path\" is missing",
         [](auto& f) { target(f, 0).erase("path"); }},
    };
    REQUIRE(test::refusal_of(moving_triangle()).message.empty());
    for (const auto& defect : defects) {
        DYNAMIC_SECTION(defect.name) {
            auto file = moving_triangle();
            defect.inflict(file);
            const auto refusal = test::refusal_of(file);
            CHECK(refusal.pointer == defect.pointer);
            CHECK_THAT(refusal.message, Contains(defect.message));
        }
    }
}

TEST_CASE("zero tangents of a rotation are not rotations", "[validate]") {
    auto file = moving_triangle();
    sampler(file, 1)["interpolation"] = "CUBICSPLINE";
    sampler(file, 1)["output"] =
        file.add_vec4s({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
    CHECK(test::refusal_of(file).message.empty());
}

TEST_CASE("the same property may be animated in two animations", "[validate]") {
    auto file = moving_triangle();
    file.json["animations"].push_back(file.json["animations"][0]);
    CHECK(file.load().animations.size() == 2);
}
