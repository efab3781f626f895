#include "defect.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

TEST_CASE("nodes, scenes, skins, cameras and lights that make no sense are refused", "[validate]") {
    const test::Defect defects[] = {
        {"a node that is its own child", "/nodes/2/children/0", "its own child",
         [](auto& f) { f.json["nodes"][2]["children"] = {2}; }},
        {"a cycle", "/nodes/3", "its own ancestor",
         [](auto& f) {
             f.json["nodes"].push_back({{"children", {4}}});
             f.json["nodes"].push_back({{"children", {3}}});
         }},
        {"two parents", "/nodes/1/children/0", "already a child of node 0",
         [](auto& f) { f.json["nodes"][0]["children"] = {2}; }},
        {"a child listed twice", "/nodes/1/children/1", "already a child of node 1",
         [](auto& f) {
             f.json["nodes"][1]["children"] = {2, 2};
         }},
        {"a scene that lists a child", "/scenes/0/nodes/1", "not a root",
         [](auto& f) {
             f.json["scenes"][0]["nodes"] = {0, 2};
         }},
        {"a scene that lists a node twice", "/scenes/0/nodes/1", "listed twice",
         [](auto& f) {
             f.json["scenes"][0]["nodes"] = {1, 1};
         }},
        {"a matrix and a scale", "/nodes/1", "both a matrix and a scale",
         [](auto& f) {
             f.json["nodes"][1]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
             f.json["nodes"][1]["scale"] = {1, 1, 1};
         }},
        {"a rotation of length zero", "/nodes/1/rotation", "length zero",
         [](auto& f) {
             f.json["nodes"][1]["rotation"] = {0, 0, 0, 0};
         }},
        {"weights without a mesh", "/nodes/1/weights", "no mesh",
         [](auto& f) { f.json["nodes"][1]["weights"] = {1}; }},
        {"weights without targets", "/nodes/0/weights", "1 morph weights; mesh 0 has 0 targets",
         [](auto& f) { f.json["nodes"][0]["weights"] = {1}; }},
        {"a skin without a mesh", "/nodes/1/skin", "no mesh",
         [](auto& f) { f.json["nodes"][1]["skin"] = 0; }},
        {"a skin on a mesh without joints", "/nodes/0/skin", "primitive 0 of mesh 0 has no JOINTS_0",
         [](auto& f) {
             auto& attributes = f.json["meshes"][0]["primitives"][0]["attributes"];
             attributes.erase("JOINTS_0");
             attributes.erase("WEIGHTS_0");
         }},
        {"a joint the skin does not have", "/nodes/0/skin", "follows joint 1; skin 0 has 1 joints",
         [](auto& f) { f.json["skins"][0]["joints"] = {1}; }},
        {"a skin without joints", "/skins/0/joints", "at least 1",
         [](auto& f) { f.json["skins"][0]["joints"] = json::array(); }},
        {"too few inverse bind matrices", "/skins/0/inverseBindMatrices",
         "1 inverse bind matrices for 2 joints",
         [](auto& f) {
             f.json["skins"][0]["inverseBindMatrices"] =
                 f.add_accessor(std::vector<float>(16, 1.0f), test::float32, "MAT4", 1);
         }},
        {"inverse bind matrices that are vectors", "/skins/0/inverseBindMatrices",
         "they must be MAT4 of FLOAT", [](auto& f) { f.json["skins"][0]["inverseBindMatrices"] = 0; }},
        {"inverse bind matrices that are not finite", "/skins/0/inverseBindMatrices", "joint 1 holds nan",
         [](auto& f) {
             std::vector<float> values(32, 1.0f);
             values[20] = std::numeric_limits<float>::quiet_NaN();
             f.json["skins"][0]["inverseBindMatrices"] = f.add_accessor(values, test::float32, "MAT4", 2);
         }},
        {"a camera without its lens", "/cameras/0", "\"orthographic\" is missing",
         [](auto& f) {
             f.json["cameras"] = {{{"type", "orthographic"}, {"perspective", {{"znear", 1}, {"yfov", 1}}}}};
         }},
        {"a far plane before the near plane", "/cameras/0/perspective/zfar", "not beyond",
         [](auto& f) {
             f.json["cameras"] = {
                 {{"type", "perspective"}, {"perspective", {{"znear", 1}, {"zfar", 1}, {"yfov", 1}}}}};
         }},
        {"a camera of no width", "/cameras/0/orthographic/xmag", "zero",
         [](auto& f) {
             f.json["cameras"] = {{{"type", "orthographic"},
                                   {"orthographic", {{"znear", 1}, {"zfar", 2}, {"xmag", 0}, {"ymag", 1}}}}};
         }},
        {"a spot light without its cone", "/extensions/KHR_lights_punctual/lights/0", "\"spot\" is missing",
         [](auto& f) {
             f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}}};
         }},
        {"a cone inside out", "/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", "wider",
         [](auto& f) {
             f.json["extensions"]["KHR_lights_punctual"]["lights"] = {
                 {{"type", "spot"}, {"spot", {{"innerConeAngle", 1}}}}};
         }},
        {"an unknown light", "/extensions/KHR_lights_punctual/lights/0/type", "directional, point, spot",
         [](auto& f) {
             f.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "area"}}};
         }},
    };
    for (const auto& defect : defects) {
        DYNAMIC_SECTION(defect.name) {
            auto file = test::skinned_triangle();
            defect.inflict(file);
            const auto refusal = test::refusal_of(file);
            CHECK(refusal.pointer == defect.pointer);
            CHECK_THAT(refusal.message, Contains(defect.message));
        }
    }
}

TEST_CASE("a joint without weight need not exist", "[validate]") {
    auto file = test::skinned_triangle();
    file.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] =
        file.add_accessor<std::uint8_t>({0, 1, 200, 200, 0, 200, 0, 0, 0, 0, 0, 0}, test::uint8, "VEC4", 3);
    CHECK(file.load().meshes[0].primitives[0].influences.joints[2] == 0);
}

TEST_CASE("a long chain of nodes is walked without recursion", "[validate]") {
    auto file = test::one_triangle();
    file.json["nodes"] = json::array();
    for (int i = 0; i < 100'000; ++i) file.json["nodes"].push_back({{"children", {i + 1}}});
    file.json["nodes"].push_back({{"mesh", 0}});
    CHECK(file.load().nodes.back().parent == 99'999u);
}
