// The program against the evaluator on files made to be hard to read right.

#include "agreement.h"
#include "random_file.h"
#include "tests/anim/gltf_builder.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace gridreel;
using nlohmann::json;

namespace {

/// Two clips of it agree, or one when it has a single animation.
void check(const test::GltfBuilder& file) {
    const test::TemporaryFolder folder;
    const std::size_t compared = test::check_agreement(folder.write("nasty.gltf", file.gltf()));
    CHECK(compared > 0);
}

/// A triangle with two morph targets, in nodes 0 and 1; `mesh.weights` is (0.25, 0.5).
test::GltfBuilder morphing_triangles() {
    auto file = test::one_triangle();
    json& mesh = file.json["meshes"][0];
    mesh["primitives"][0]["targets"] = {{{"POSITION", file.add_vec3s({0, 0, 1, 0, 0, 2, 0, 0, 3})}},
                                        {{"POSITION", file.add_vec3s({1, 0, 0, 2, 0, 0, 3, 0, 0})}}};
    mesh["weights"] = {0.25, 0.5};
    file.json["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 3, 0}}, {"weights", {1, 1}}}};
    file.json["scenes"][0]["nodes"] = {0, 1};
    return file;
}

/// Appends an animation of one channel with keys at 0, 1 and 2 seconds.
void animate(test::GltfBuilder& file, const json& target, std::size_t output,
             const std::string& interpolation = "LINEAR") {
    const std::size_t input = file.add_scalars({0, 1, 2});
    file.json["animations"].push_back(
        {{"samplers",
          json::array({{{"input", input}, {"output", output}, {"interpolation", interpolation}}})},
         {"channels", json::array({{{"sampler", 0}, {"target", target}}})}});
}

json pointer(const std::string& to) {
    return {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", to}}}}}};
}

}  // namespace

TEST_CASE("random files agree with the evaluator vertex by vertex", "[evaluator]") {
    const test::TemporaryFolder folder;
    std::size_t compared = 0;
    for (std::uint32_t seed = 1; seed <= 400; ++seed) {
        CAPTURE(seed);
        const auto file = test::random_file(seed);
        compared += test::check_agreement(seed % 2 == 0 ? folder.write("random.glb", file.glb())
                                                        : folder.write("random.gltf", file.gltf()));
    }
    CHECK(compared > 400 * 12);
}

TEST_CASE("morph weights come from the node, else from the mesh, animated or not", "[evaluator]") {
    auto file = morphing_triangles();
    check(file);
    SECTION("the weights of a node that states none") {
        animate(file, {{"node", 0}, {"path", "weights"}}, file.add_scalars({0, 1, 1, 0, -1, 2}));
    }
    SECTION("one weight of a node") {
        animate(file, pointer("/nodes/1/weights/1"), file.add_scalars({0, 1, -1}));
    }
    SECTION("one weight of a node that states none: the other is the mesh's") {
        animate(file, pointer("/nodes/0/weights/1"), file.add_scalars({0, 1, -1}));
    }
    SECTION("the weights of the mesh, which move the first node only") {
        animate(file, pointer("/meshes/0/weights"), file.add_scalars({0, 1, 1, 0, -1, 2}));
    }
    SECTION("one weight of the mesh") {
        animate(file, pointer("/meshes/0/weights/0"), file.add_scalars({0, 1, -1}), "STEP");
    }
    SECTION("each weight by an animation of its own") {
        animate(file, pointer("/nodes/1/weights/1"), file.add_scalars({0, 1, -1}));
        animate(file, pointer("/nodes/1/weights/0"), file.add_scalars({1, 3, 2}));
    }
    SECTION("one weight by one animation, all by another") {
        animate(file, pointer("/nodes/1/weights/1"), file.add_scalars({0, 1, -1}));
        animate(file, {{"node", 1}, {"path", "weights"}}, file.add_scalars({0, 1, 1, 0, -1, 2}));
    }
    file.json["extensionsUsed"] = {"KHR_animation_pointer"};
    check(file);
}

TEST_CASE("pointers may lead to integers that are not fractions", "[evaluator]") {
    auto file = test::one_triangle();
    file.json["extensionsUsed"] = {"KHR_animation_pointer"};
    const std::vector<std::int8_t> moves{1, 2, 3, -4, 5, -6, 7, -8, 127};
    animate(file, pointer("/nodes/0/translation"), file.add_accessor(moves, test::int8, "VEC3", 3));
    const std::vector<std::uint16_t> stretches{1, 2, 3, 4, 5, 6, 7, 8, 300};
    animate(file, pointer("/nodes/0/scale"), file.add_accessor(stretches, test::uint16, "VEC3", 3));
    check(file);
}

TEST_CASE("the lowest signed integer stands for -1, as the one above it does", "[evaluator]") {
    auto file = test::one_triangle();
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    std::size_t positions = 0;
    SECTION("bytes") {
        const std::vector<std::int8_t> bytes{-128, -127, 0, 0, 127, -128, 0, 0, -128, 0, 64, 0};
        positions = file.add_accessor(bytes, test::int8, "VEC3", 3);
        file.json["bufferViews"].back()["byteStride"] = 4;
    }
    SECTION("shorts") {
        const std::vector<std::int16_t> shorts{-32768, -32767, 0, 0, 32767, -32768, 0, 0, -32768, 0, 9, 0};
        positions = file.add_accessor(shorts, test::int16, "VEC3", 3);
        file.json["bufferViews"].back()["byteStride"] = 8;
    }
    file.json["accessors"][positions]["normalized"] = true;
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
    check(file);
}

TEST_CASE("channels without a node move nothing", "[evaluator]") {
    auto file = test::one_triangle();
    const std::size_t moves = file.add_vec3s({0, 0, 0, 5, 0, 0, 0, 5, 0});
    animate(file, {{"path", "translation"}}, moves);
    animate(file, {{"node", 0}, {"path", "translation"}}, moves);
    check(file);
}

TEST_CASE("every scene of a file has its own roots, and a file without scenes shows all", "[evaluator]") {
    auto file = morphing_triangles();
    file.json["nodes"].push_back({{"children", {0}}, {"scale", {1, 1, -2}}});
    file.json["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2, 1}}}, json::object()};
    file.json["scene"] = 1;
    check(file);
    file.json.erase("scene");
    check(file);
    file.json.erase("scenes");
    check(file);
}

TEST_CASE("a skinned mesh follows its joints wherever it hangs", "[evaluator]") {
    auto file = test::skinned_triangle();
    file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {9, 9, 9}}},
                          {{"children", {2}}, {"scale", {1, 2, -3}}, {"rotation", {0, 0.6, 0, 0.8}}},
                          {{"children", {0}}, {"translation", {1, 0, 0}}}};
    file.json["scenes"][0]["nodes"] = {1};
    animate(file, {{"node", 2}, {"path", "rotation"}},
            file.add_vec4s({0, 0, 0, 1, 0, 0, 0.707f, 0.707f, 0, 0, -1, 0}));
    animate(file, {{"node", 0}, {"path", "translation"}}, file.add_vec3s({0, 0, 0, 5, 0, 0, 0, 5, 0}));
    check(file);
}

TEST_CASE("keys may turn by half a turn, by nothing, and through quaternions of opposite sign",
          "[evaluator]") {
    auto file = test::one_triangle();
    SECTION("half a turn") {
        animate(file, {{"node", 0}, {"path", "rotation"}},
                file.add_vec4s({0, 0, 0, 1, 0, 0, 0.9999f, 0.0141f, 0, 0, 0, -1}));
    }
    SECTION("nothing, and opposite signs") {
        animate(file, {{"node", 0}, {"path", "rotation"}},
                file.add_vec4s({0, 0.6f, 0, 0.8f, 0, -0.6f, 0, -0.8f, 0, 0.6f, 0, 0.8000001f}));
    }
    SECTION("bytes that are a little too long to be of unit length") {
        const std::vector<std::int8_t> turns{0, 0, 90, 90, 0, 1, 90, 90, 0, 0, -90, -91};
        const auto output = file.add_accessor(turns, test::int8, "VEC4", 3);
        file.json["accessors"][output]["normalized"] = true;
        animate(file, {{"node", 0}, {"path", "rotation"}}, output);
    }
    SECTION("cubic splines leave the unit sphere between keys") {
        animate(file, {{"node", 0}, {"path", "rotation"}},
                file.add_vec4s({0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0,  //
                                0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 2, 0,  //
                                1, 1, 1, 1, 0, 1, 0, 0, 0, 0, 0, 0}),
                "CUBICSPLINE");
    }
    check(file);
}

TEST_CASE("buffers may lie in files with escaped names, beside the file's own", "[evaluator]") {
    auto file = test::one_triangle();
    const test::TemporaryFolder folder;
    folder.write("a b\xc3\xa9.bin", file.buffer);
    const std::size_t size = file.buffer.size();
    file.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", size}});
    file.json["accessors"][0]["bufferView"] = 2;
    file.json["buffers"] = {{{"byteLength", size}}, {{"byteLength", size}, {"uri", "a%20b%C3%A9.bin"}}};
    const std::size_t compared = test::check_agreement(folder.write("nasty.glb", file.glb()));
    CHECK(compared > 0);
}
