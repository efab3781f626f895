// What a frame takes, and files of a few bytes that would make it take everything.

#include "anim/frame_size.h"

#include "anim/error.h"
#include "anim/frame_geometry.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <string>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

anim::FrameSize size_of(const test::GltfBuilder& file) {
    const auto scene = file.load();
    return anim::measure_frame(scene, anim::choose_clip(scene));
}

/// Why it cannot be laid out; empty when it can.
std::string refusal_to_lay_out(const test::GltfBuilder& file) {
    const auto scene = file.load();
    try {
        static_cast<void>(anim::lay_out(scene, anim::choose_clip(scene)));
        return {};
    } catch (const Error& error) {
        CHECK_FALSE(error.remedy().empty());
        return error.what();
    }
}

/// A triangle at `count` places, none of which has a byte in the file.
test::GltfBuilder instanced(std::size_t count) {
    auto file = test::one_triangle();
    file.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    file.json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", count}});
    file.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        file.json["accessors"].size() - 1;
    return file;
}

/// A file whose vertices have no bytes in it either.
test::GltfBuilder all_zero(test::GltfBuilder file, std::size_t vertices) {
    file.json["accessors"][0].erase("bufferView");
    file.json["accessors"][0]["count"] = vertices;
    file.json["meshes"][0]["primitives"][0].erase("indices");
    return file;
}

}  // namespace

TEST_CASE("a frame has every primitive of every instance of every node", "[frame_size]") {
    auto file = instanced(5);
    file.json["meshes"][0]["primitives"].push_back(json(file.json["meshes"][0]["primitives"][0]));
    file.json["nodes"].push_back({{"mesh", 0}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.json["nodes"].push_back({{"mesh", 0}});  // in no scene
    const auto size = size_of(file);
    CHECK(size.vertices == 6 * 2 * 3);
    CHECK(size.triangles == 6 * 2);
    CHECK(size.largest_node == 0);

    const auto scene = file.load();
    const auto frame = anim::lay_out(scene, anim::choose_clip(scene));
    CHECK(double(frame.positions.size()) == size.vertices);
    CHECK(double(frame.triangles.size()) == size.triangles);
}

TEST_CASE("the measure is no less than what is laid out", "[frame_size]") {
    for (const auto& file : {test::one_triangle(), test::skinned_triangle(), instanced(100)}) {
        const auto scene = file.load();
        const auto clip = anim::choose_clip(scene);
        const auto frame = anim::lay_out(scene, clip);
        const auto bytes = [](const auto& values) { return double(values.size() * sizeof(values[0])); };
        const auto& scratch = frame.scratch;
        const double taken = bytes(frame.positions) + bytes(frame.normals) + bytes(frame.tangents) +
                             bytes(frame.triangles) + bytes(frame.triangle_part) + bytes(frame.parts) +
                             bytes(scratch.all_runs) + bytes(scratch.moving_runs) +
                             bytes(scratch.map_ranges) + bytes(scratch.placements) + bytes(scratch.maps) +
                             bytes(scratch.rows);
        CHECK(anim::measure_frame(scene, clip).bytes >= taken);
        CHECK(anim::measure_frame(scene, clip).bytes < 4.0 * taken);
    }
}

TEST_CASE("a small file that claims four billion vertices is refused before they are allocated",
          "[frame_size]") {
    const auto file = all_zero(test::one_triangle(), 4'294'967'295);
    CHECK(file.gltf().size() < 1024);
    const auto refusal = test::refusal_of(file);
    CHECK(refusal.pointer == "/meshes/0/primitives/0");
    CHECK_THAT(refusal.message, Contains("more memory than a file of this size may ask for"));
}

TEST_CASE("a small file with millions of instances is refused before they are laid out", "[frame_size]") {
    SECTION("more than can be read") {
        const auto file = instanced(16'000'000);
        CHECK(file.gltf().size() < 1024);
        CHECK_THAT(test::refusal_of(file).message, Contains("more memory than a file of this size"));
    }
    SECTION("few enough to be read, each of a large mesh") {
        const auto file = all_zero(instanced(1'000'000), 60'000);
        CHECK(file.gltf().size() < 1024);
        CHECK_THAT(refusal_to_lay_out(file), Contains("test: /nodes/0: ") && Contains("2^32 - 1"));
    }
    SECTION("fewer than 2^32 vertices, and yet too many") {
        const auto file = all_zero(instanced(100'000), 30'000);
        CHECK(file.gltf().size() < 1024);
        CHECK_THAT(refusal_to_lay_out(file), Contains("test: /nodes/0: ") &&
                                                 Contains("3000000000 vertices") &&
                                                 Contains("fewer instances"));
    }
}

TEST_CASE("nodes, primitives and joints that multiply each other are refused", "[frame_size]") {
    auto file = test::skinned_triangle();
    auto& primitives = file.json["meshes"][0]["primitives"];
    constexpr std::size_t count = 300;
    while (primitives.size() < count) primitives.push_back(json(primitives[0]));
    file.json["skins"][0]["joints"] = json::array({1, 2});
    while (file.json["skins"][0]["joints"].size() < count) file.json["skins"][0]["joints"].push_back(1);
    for (std::size_t i = 0; i < count; ++i) {
        file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
        file.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    }
    CHECK(file.gltf().size() < 64 * 1024);
    // 301 times 300 parts are few, and 300 matrices for each of them are not.
    CHECK_THAT(refusal_to_lay_out(file), Contains("270900 vertices") && Contains("MiB"));
}
