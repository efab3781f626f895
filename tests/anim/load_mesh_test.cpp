#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace gridreel;
using Catch::Matchers::Contains;

namespace {

/// Five vertices (i, 0, 0), drawn without indices in the given mode.
test::GltfBuilder five_vertices(int mode) {
    auto file = test::one_triangle();
    file.json["meshes"][0]["primitives"][0] = {
        {"attributes", {{"POSITION", file.add_vec3s({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0})}}},
        {"mode", mode}};
    return file;
}

}  // namespace

TEST_CASE("strips and fans are taken apart as the specification says", "[load]") {
    SECTION("strip") {
        const auto scene = five_vertices(5).load();
        CHECK(scene.meshes[0].primitives[0].triangles ==
              std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}});
    }
    SECTION("fan") {
        const auto scene = five_vertices(6).load();
        CHECK(scene.meshes[0].primitives[0].triangles ==
              std::vector<glm::uvec3>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}});
    }
    SECTION("triangles, with two vertices left over") {
        const auto scene = five_vertices(4).load();
        CHECK(scene.meshes[0].primitives[0].triangles == std::vector<glm::uvec3>{{0, 1, 2}});
        CHECK(scene.meshes[0].primitives[0].positions.size() == 5);
        CHECK_THAT(test::warning_at(scene, "/meshes/0/primitives/0"), Contains("5 indices"));
    }
    SECTION("an indexed strip keeps its degenerate triangles") {
        auto file = five_vertices(5);
        file.json["meshes"][0]["primitives"][0]["indices"] =
            file.add_accessor<std::uint8_t>({0, 1, 1, 4}, test::uint8, "SCALAR", 4);
        CHECK(file.load().meshes[0].primitives[0].triangles == std::vector<glm::uvec3>{{0, 1, 1}, {1, 4, 1}});
    }
}

TEST_CASE("points and lines are left out with a warning", "[load]") {
    for (int mode = 0; mode < 4; ++mode) {
        const auto scene = five_vertices(mode).load();
        CHECK(scene.meshes[0].primitives.empty());
        CHECK_THAT(test::warning_at(scene, "/meshes/0/primitives/0"), Contains("not drawn"));
    }
}

TEST_CASE("a primitive without positions is left out with a warning", "[load]") {
    auto file = test::one_triangle();
    file.json["meshes"][0]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
    const auto scene = file.load();
    CHECK(scene.meshes[0].primitives.empty());
    CHECK_THAT(test::warning_at(scene, "/meshes/0/primitives/0"), Contains("no positions"));
}

TEST_CASE("attributes are read per vertex", "[load]") {
    auto file = test::one_triangle();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = file.add_vec3s({0, 0, 1, 0, 1, 0, 1, 0, 0});
    attributes["TANGENT"] = file.add_vec4s({1, 0, 0, 1, 1, 0, 0, -1, 0, 1, 0, 1});
    attributes["TEXCOORD_0"] = file.add_accessor<float>({0, 0.5f, 1, 0.25f, 0, 0}, test::float32, "VEC2", 3);
    attributes["TEXCOORD_1"] =
        file.add_accessor<std::uint8_t>({0, 255, 51, 0, 255, 255}, test::uint8, "VEC2", 3);
    file.json["accessors"].back()["normalized"] = true;
    attributes["COLOR_0"] = file.add_vec3s({1, 0, 0, 0, 1, 0, 0, 0, 0.5f});
    file.json["meshes"][0]["name"] = "sheet";
    file.json["materials"] = {{{"name", "paper"}}};
    file.json["meshes"][0]["primitives"][0]["material"] = 0;

    const auto scene = file.load();
    const auto& primitive = scene.meshes[0].primitives[0];
    CHECK(scene.meshes[0].name == "sheet");
    CHECK(primitive.material == 0u);
    CHECK(primitive.normals[1] == glm::vec3(0, 1, 0));
    CHECK(primitive.tangents[1] == glm::vec4(1, 0, 0, -1));
    CHECK(primitive.texcoords[0] == std::vector<glm::vec2>{{0, 0.5f}, {1, 0.25f}, {0, 0}});
    CHECK(primitive.texcoords[1] == std::vector<glm::vec2>{{0, 1}, {0.2f, 0}, {1, 1}});
    CHECK(primitive.colors == std::vector<glm::vec4>{{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 0.5f, 1}});
}

TEST_CASE("tangents without normals are ignored", "[load]") {
    auto file = test::one_triangle();
    file.json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] =
        file.add_vec4s({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
    const auto scene = file.load();
    CHECK(scene.meshes[0].primitives[0].normals.empty());
    CHECK(scene.meshes[0].primitives[0].tangents.empty());
}

TEST_CASE("normals that are not finite become zero, with a warning", "[load]") {
    auto file = test::one_triangle();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    file.json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
        file.add_vec3s({0, 0, 1, nan, nan, nan, 0, 0, 1});
    const auto scene = file.load();
    CHECK(scene.meshes[0].primitives[0].normals[1] == glm::vec3(0));
    CHECK_THAT(test::warning_at(scene, "/meshes/0/primitives/0/attributes/NORMAL"), Contains("3 components"));
}

TEST_CASE("quantized positions are read where the extension is listed", "[load]") {
    auto file = test::one_triangle();
    file.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = file.add_accessor<std::int16_t>(
        {0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0}, test::int16, "VEC3", 3);
    file.json["bufferViews"].back()["byteStride"] = 8;
    file.json["accessors"].back()["normalized"] = true;
    file.json["extensionsUsed"] = {"KHR_mesh_quantization"};
    file.json["extensionsRequired"] = {"KHR_mesh_quantization"};

    const auto scene = file.load();
    CHECK(scene.meshes[0].primitives[0].positions ==
          std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}});
    CHECK(scene.warnings.empty());
}

TEST_CASE("morph targets are read, with the mesh's default weights", "[load]") {
    auto file = test::one_triangle();
    auto& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["NORMAL"] = file.add_vec3s({0, 0, 1, 0, 0, 1, 0, 0, 1});
    const auto lift = file.add_vec3s({0, 0, 1, 0, 0, 2, 0, 0, 3});
    primitive["targets"] = {{{"POSITION", lift}}, {{"NORMAL", lift}, {"TANGENT", lift}}};

    SECTION("zeros when the file has none") {
        CHECK(file.load().meshes[0].weights == std::vector<float>{0, 0});
    }
    SECTION("as stated, by mesh and node") {
        file.json["meshes"][0]["weights"] = {0.25, 1};
        file.json["nodes"][0]["weights"] = {0.5, -2};
        const auto scene = file.load();
        CHECK(scene.meshes[0].weights == std::vector<float>{0.25f, 1});
        CHECK(scene.nodes[0].weights == std::vector<float>{0.5f, -2});

        const auto& targets = scene.meshes[0].primitives[0].targets;
        REQUIRE(targets.size() == 2);
        CHECK(targets[0].positions == std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 2}, {0, 0, 3}});
        CHECK(targets[0].normals.empty());
        CHECK(targets[1].positions.empty());
        CHECK(targets[1].normals.size() == 3);
        CHECK(targets[1].tangents.empty());  // the base has none
    }
}

TEST_CASE("skin weights whose sum no float holds are divided by it all the same", "[load]") {
    auto file = test::skinned_triangle();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = file.add_vec4s({3e38f, 3e38f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    const auto weights = file.load().meshes[0].primitives[0].influences.weights;
    CHECK(std::vector<float>(weights.begin(), weights.begin() + 2) == std::vector<float>{0.5f, 0.5f});
}

TEST_CASE("skin weights are divided by their sum", "[load]") {
    auto file = test::skinned_triangle();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = file.add_vec4s({0.5f, 1.5f, 0, 0, 0, 0, 0, 0, 0.5f, 0, 0, 0});

    const auto scene = file.load();
    const auto& influences = scene.meshes[0].primitives[0].influences;
    CHECK(influences.per_vertex == 4);
    CHECK(influences.weights == std::vector<float>{0.25f, 0.75f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    CHECK(influences.joints == std::vector<std::uint16_t>{0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
}

TEST_CASE("all JOINTS_n/WEIGHTS_n pairs end up side by side", "[load]") {
    auto file = test::skinned_triangle();
    auto& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] =
        file.add_accessor<std::uint16_t>({1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1}, test::uint16, "VEC4", 3);
    attributes["WEIGHTS_1"] =
        file.add_accessor<std::uint8_t>({255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 255}, test::uint8, "VEC4", 3);
    file.json["accessors"].back()["normalized"] = true;

    const auto scene = file.load();
    const auto& influences = scene.meshes[0].primitives[0].influences;
    CHECK(influences.per_vertex == 8);
    // Vertex 0: 0.5 and 0.5 from the first pair, 1 from the second; sum 2.
    CHECK(influences.weights == std::vector<float>{0.25f, 0.25f, 0, 0, 0.5f, 0,    0, 0,  //
                                                   0.5f,  0,     0, 0, 0,    0.5f, 0, 0,  //
                                                   0.5f,  0,     0, 0, 0,    0,    0, 0.5f});
    CHECK(influences.joints == std::vector<std::uint16_t>{0, 1, 0, 0, 1, 0, 0, 0,  //
                                                          1, 0, 0, 0, 0, 1, 0, 0,  //
                                                          0, 0, 0, 0, 0, 0, 0, 1});
}
