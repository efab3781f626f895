// EXT_mesh_gpu_instancing: copies of a node's mesh.

#include "anim/frame_geometry.h"
#include "gltf_builder.h"
#include "scene_builder.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace gridreel;
using Catch::Matchers::Contains;

namespace {

constexpr float root_half = 0.70710678f;

/// A triangle at three places: moved by x = 1, turned a quarter about z, twice as large.
test::GltfBuilder three_triangles() {
    auto file = test::one_triangle();
    file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    file.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const auto translations = file.add_vec3s({1, 0, 0, 0, 0, 0, 0, 0, 0});
    const auto rotations = file.add_vec4s({0, 0, 0, 1, 0, 0, root_half, root_half, 0, 0, 0, 1});
    const auto scales = file.add_vec3s({1, 1, 1, 1, 1, 1, 2, 2, 2});
    file.json["nodes"][0]["translation"] = {0, 0, 5};
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}};
    return file;
}

nlohmann::json& attributes_of(test::GltfBuilder& file) {
    return file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

}  // namespace

TEST_CASE("every instance is a part, in order, seen from the node", "[load][instances]") {
    const auto frame = anim::testing::frame_at(three_triangles().load(), 0.0);
    REQUIRE(frame.parts.size() == 3);
    REQUIRE(frame.triangles.size() == 3);
    CHECK(frame.parts[2].instance == 2);

    // The triangle's second vertex is (1, 0, 0).
    const auto second = [&](std::size_t instance) { return frame.positions[3 * instance + 1]; };
    CHECK(anim::testing::distance(second(0), glm::vec3(2, 0, 5)) < 1e-6);
    CHECK(anim::testing::distance(second(1), glm::vec3(0, 1, 5)) < 1e-6);
    CHECK(anim::testing::distance(second(2), glm::vec3(2, 0, 5)) < 1e-6);
}

TEST_CASE("rotations of instances may be normalized integers, and attributes of their own are let be",
          "[load][instances]") {
    auto file = three_triangles();
    const auto rotations = file.add_accessor<std::int16_t>(
        {0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767}, test::int16, "VEC4", 3);
    file.json["accessors"][rotations]["normalized"] = true;
    attributes_of(file)["ROTATION"] = rotations;
    attributes_of(file)["_ID"] = file.add_scalars({1, 2});
    const auto frame = anim::testing::frame_at(file.load(), 0.0);
    CHECK(anim::testing::distance(frame.positions[4], glm::vec3(0, 1, 5)) < 1e-6);
}

TEST_CASE("one attribute is enough for instances", "[load][instances]") {
    auto file = three_triangles();
    attributes_of(file).erase("ROTATION");
    attributes_of(file).erase("TRANSLATION");
    CHECK(anim::testing::frame_at(file.load(), 0.0).triangles.size() == 3);
    attributes_of(file).erase("SCALE");
    CHECK(anim::testing::frame_at(file.load(), 0.0).triangles.size() == 1);
}

TEST_CASE("instances that do not fit together are refused", "[validate][instances]") {
    auto file = three_triangles();
    attributes_of(file)["SCALE"] = file.add_vec3s({1, 1, 1});
    CHECK_THAT(test::refusal_of(file).message, Contains("there are 1 elements"));

    attributes_of(file)["SCALE"] = file.add_vec4s({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    CHECK_THAT(test::refusal_of(file).message, Contains("it must be VEC3 of FLOAT"));

    attributes_of(file)["SCALE"] = 99;
    CHECK_THAT(test::refusal_of(file).message, Contains("out of range"));

    file = three_triangles();
    attributes_of(file)["ROTATION"] = file.add_vec4s({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1});
    CHECK_THAT(test::refusal_of(file).message, Contains("the rotation of instance 1"));

    file = three_triangles();
    const float infinite = std::numeric_limits<float>::infinity();
    attributes_of(file)["TRANSLATION"] = file.add_vec3s({0, 0, 0, 0, infinite, 0, 0, 0, 0});
    CHECK_THAT(test::refusal_of(file).message, Contains("component 4 is inf"));
}

TEST_CASE("more instances than a small file may ask for are refused before memory is",
          "[validate][instances]") {
    auto file = three_triangles();
    auto& accessors = file.json["accessors"];
    accessors.push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 4'000'000'000}});
    attributes_of(file) = {{"TRANSLATION", accessors.size() - 1}};
    CHECK_THAT(test::refusal_of(file).message, Contains("more memory than a file of this size"));
}

TEST_CASE("instances of nothing, and of skins, are named in a warning", "[load][instances]") {
    auto bare = three_triangles();
    bare.json["nodes"][0].erase("mesh");
    const std::string where = "/nodes/0/extensions/EXT_mesh_gpu_instancing";
    CHECK_THAT(test::warning_at(bare.load(), where), Contains("no mesh"));

    auto skinned = test::skinned_triangle();
    skinned.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        skinned.add_vec3s({0, 0, 0, 1, 1, 1});
    const auto scene = skinned.load();
    CHECK_THAT(test::warning_at(scene, where), Contains("skinned"));
    CHECK(anim::testing::frame_at(scene, 0.0).parts.size() == 1);
}
