// Primitives compressed by Draco's own encoder, held against what went in.

#include "anim/gltf/draco_primitives.h"

#include "draco_builder.h"

#include <catch2/catch.hpp>
#include <glm/glm.hpp>

#include <algorithm>
#include <functional>

using namespace gridreel;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

constexpr auto khr = "KHR_draco_mesh_compression";

json& primitive_of(test::GltfBuilder& file) {
    return file.json["meshes"][0]["primitives"][0];
}

json& draco_of(test::GltfBuilder& file) {
    return primitive_of(file)["extensions"][khr];
}

/// The accessor of an attribute.
json& accessor_of(test::GltfBuilder& file, const char* name) {
    return file.json["accessors"][primitive_of(file)["attributes"][name].get<std::size_t>()];
}

/// Each triangle from its lowest vertex on, in ascending order.
std::vector<std::array<std::uint32_t, 3>> sorted(const std::vector<glm::uvec3>& triangles,
                                                 const std::function<std::uint32_t(std::uint32_t)>& number) {
    std::vector<std::array<std::uint32_t, 3>> list;
    for (const glm::uvec3& t : triangles) {
        auto& turned = list.emplace_back(std::array{number(t.x), number(t.y), number(t.z)});
        std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
    }
    std::sort(list.begin(), list.end());
    return list;
}

/// Vertices are told by their joints, whatever their order.
void check_is(const anim::Primitive& primitive, const test::PlainMesh& mesh,
              const test::DracoSettings& settings) {
    REQUIRE(primitive.positions.size() == mesh.positions.size());
    REQUIRE(primitive.influences.per_vertex == 4);
    const auto number = [&](std::uint32_t vertex) -> std::uint32_t {
        return primitive.influences.joints[4 * vertex];
    };
    CHECK(sorted(primitive.triangles, number) == sorted(mesh.triangles, [](std::uint32_t v) { return v; }));

    glm::vec3 low = mesh.positions[0], high = low;
    for (const glm::vec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
    const glm::vec3 extent = high - low;
    const float step = std::max({extent.x, extent.y, extent.z}) / float((1 << settings.position_bits) - 1);
    const float other = 2.0f / float((1 << settings.other_bits) - 1);
    float worst_position = 0, worst_normal = 0, worst_texcoord = 0, worst_color = 0, worst_weight = 0;
    std::vector<bool> seen(mesh.positions.size(), false);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const std::uint32_t i = number(v);
        REQUIRE(i < seen.size());
        seen[i] = true;
        const auto raise = [](float& worst, float value) { worst = std::max(worst, value); };
        raise(worst_position, glm::distance(primitive.positions[v], mesh.positions[i]));
        raise(worst_normal, glm::distance(primitive.normals[v], mesh.normals[i]));
        raise(worst_texcoord, glm::distance(primitive.texcoords[0][v], mesh.texcoords[i]));
        raise(worst_color, glm::distance(primitive.colors[v], glm::vec4(mesh.colors[i]) / 255.0f));
        for (int k = 0; k < 4; ++k)
            raise(worst_weight,
                  std::abs(primitive.influences.weights[4 * v + std::uint32_t(k)] - mesh.weights[i][k]));
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](bool s) { return s; }));
    CHECK(worst_position <= step);
    CHECK(worst_normal <= 2 * other);
    CHECK(worst_texcoord <= other);
    CHECK(worst_color < 1e-6f);
    CHECK(worst_weight <= other);
}

}  // namespace

TEST_CASE("primitives compressed by Draco are the original's within a step", "[draco]") {
    for (const bool sequential : {false, true})
        for (const int speed : {0, 3, 5, 7, 10})
            for (const std::uint32_t cells : {2u, 3u, 12u, 40u}) {
                INFO((sequential ? "sequential" : "edgebreaker") << ", speed " << speed << ", " << cells);
                const auto mesh = test::bumpy_sheet(cells, cells);
                const test::DracoSettings settings{.sequential = sequential, .speed = speed};
                const auto scene = test::draco_file(mesh, settings).load();
                CHECK(scene.warnings.size() == 1);  // there is no scene
                check_is(scene.meshes.at(0).primitives.at(0), mesh, settings);
            }
}

TEST_CASE("a strip is decoded to its triangles, whatever its number of indices", "[draco]") {
    const auto mesh = test::bumpy_sheet(1, 4);
    auto file = test::draco_file(mesh, test::DracoSettings{});
    primitive_of(file)["mode"] = 5;
    file.json["accessors"].back()["count"] = 77;
    check_is(file.load().meshes[0].primitives[0], mesh, {});
}

TEST_CASE("a compressed primitive needs neither mode nor indices", "[draco]") {
    const auto mesh = test::bumpy_sheet(1, 4);
    auto file = test::draco_file(mesh, test::DracoSettings{});
    primitive_of(file).erase("mode");
    primitive_of(file).erase("indices");
    check_is(file.load().meshes[0].primitives[0], mesh, {});
}

TEST_CASE("what is not compressed comes from its accessors", "[draco]") {
    // The sequential method keeps the order of vertices.
    const auto mesh = test::bumpy_sheet(5, 3);
    auto file = test::draco_file(mesh, test::DracoSettings{.sequential = true});
    std::vector<float> uvs, moves;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        uvs.insert(uvs.end(), {float(i), 0.5f});
        moves.insert(moves.end(), {float(i), 1.0f, 2.0f});
    }
    const auto texcoords = file.add_accessor(uvs, test::float32, "VEC2", mesh.positions.size());
    primitive_of(file)["attributes"]["TEXCOORD_1"] = texcoords;
    primitive_of(file)["targets"][0]["POSITION"] = file.add_vec3s(moves);

    const auto scene = file.load();
    const auto& primitive = scene.meshes[0].primitives[0];
    check_is(primitive, mesh, {.sequential = true});
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        CHECK(primitive.texcoords[1][v] == glm::vec2(v, 0.5f));
        CHECK(primitive.targets.at(0).positions[v] == glm::vec3(v, 1, 2));
    }
}

TEST_CASE("integers are converted where they fit", "[draco]") {
    auto mesh = test::bumpy_sheet(1, 3);
    auto file = test::draco_file(mesh, test::DracoSettings{});
    accessor_of(file, "JOINTS_0")["componentType"] = test::uint8;
    check_is(file.load().meshes[0].primitives[0], mesh, {});

    mesh.joints[0].y = 256;
    file = test::draco_file(mesh, test::DracoSettings{});
    accessor_of(file, "JOINTS_0")["componentType"] = test::uint8;
    CHECK_THAT(test::refusal_of(file).message, Contains("JOINTS_0") && Contains("do not fit UNSIGNED_BYTE"));
}

TEST_CASE("the uncompressed copy stands in for what Draco cannot decode", "[draco]") {
    const auto mesh = test::bumpy_sheet(1, 2);
    auto stream = test::encode_draco(mesh, {});
    stream.resize(stream.size() / 2);
    auto file = test::draco_file(mesh, stream);
    const std::string place = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    CHECK(test::refusal_of(file).pointer == place);

    // With the copy of some attributes, but not of all, the rest would be zeros.
    const auto fill = [&](const char* name, std::size_t view) {
        accessor_of(file, name)["bufferView"] = view;
    };
    std::vector<std::uint16_t> indices;
    for (const auto& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) indices.push_back(static_cast<std::uint16_t>(t[k]));
    file.json.erase("extensionsRequired");
    file.json["accessors"].back()["bufferView"] = file.add_view(indices);
    fill("POSITION", file.add_view(mesh.positions));
    fill("NORMAL", file.add_view(mesh.normals));
    fill("TEXCOORD_0", file.add_view(mesh.texcoords));
    fill("COLOR_0", file.add_view(mesh.colors));
    fill("JOINTS_0", file.add_view(mesh.joints));
    CHECK(test::refusal_of(file).pointer == place);

    fill("WEIGHTS_0", file.add_view(mesh.weights));
    const auto scene = file.load();
    CHECK(scene.meshes[0].primitives[0].positions == mesh.positions);
    CHECK(scene.meshes[0].primitives[0].triangles == mesh.triangles);
    CHECK_THAT(test::warning_at(scene, place), Contains("the uncompressed copy is used"));
}

TEST_CASE("compressed data wins over the uncompressed copy", "[draco]") {
    const auto mesh = test::bumpy_sheet(1, 2);
    auto file = test::draco_file(mesh, test::DracoSettings{.sequential = true});
    accessor_of(file, "POSITION")["bufferView"] =
        file.add_view(std::vector<float>(3 * mesh.positions.size(), 9.0f));
    check_is(file.load().meshes[0].primitives[0], mesh, {.sequential = true});
}

TEST_CASE("files that do not match their Draco data are refused", "[draco]") {
    const std::string primitive = "/meshes/0/primitives/0", draco = primitive + "/extensions/" + khr;
    struct Broken {
        std::string name, pointer, message;
        void (*inflict)(test::GltfBuilder&);
    };
    const Broken broken[] = {
        {"too many vertices", draco, "has 12 points; the attributes state 13",
         [](auto& f) {
             for (auto& accessor : f.json["accessors"])
                 if (accessor["count"] == 12) accessor["count"] = 13;
         }},
        {"too few vertices", draco, "the attributes state 11",
         [](auto& f) {
             for (auto& accessor : f.json["accessors"])
                 if (accessor["count"] == 12) accessor["count"] = 11;
         }},
        {"too many indices", draco, "has 8 triangles; the indices state 9",
         [](auto& f) { f.json["accessors"].back()["count"] = 27; }},
        {"parts of triangles", primitive + "/indices", "25 indices do not make whole triangles",
         [](auto& f) { f.json["accessors"].back()["count"] = 25; }},
        {"another number of components", draco, "COLOR_0 has 3 components of UNSIGNED_BYTE",
         [](auto& f) { accessor_of(f, "COLOR_0")["type"] = "VEC3"; }},
        {"integers for floats", draco, "WEIGHTS_0 has 4 components of UNSIGNED_BYTE",
         [](auto& f) {
             accessor_of(f, "WEIGHTS_0")["componentType"] = test::uint8;
             accessor_of(f, "WEIGHTS_0")["normalized"] = true;
         }},
        {"an attribute that is not there", draco, "NORMAL is attribute 9",
         [](auto& f) { draco_of(f)["attributes"]["NORMAL"] = 9; }},
        {"an identifier beyond 32 bits", draco + "/attributes/NORMAL", "which has 32 bits",
         [](auto& f) { draco_of(f)["attributes"]["NORMAL"] = 4294967296; }},
        {"an identifier that is no number", draco + "/attributes/NORMAL", "must be a number",
         [](auto& f) { draco_of(f)["attributes"]["NORMAL"] = "1"; }},
        {"an attribute of the extension alone", draco + "/attributes/NORMAL", "has no NORMAL",
         [](auto& f) { primitive_of(f)["attributes"].erase("NORMAL"); }},
        {"no attributes", draco + "/attributes", "names no attribute",
         [](auto& f) { draco_of(f)["attributes"] = json::object(); }},
        {"points", primitive + "/mode", "only triangles", [](auto& f) { primitive_of(f)["mode"] = 0; }},
        {"a fan", primitive + "/mode", "only triangles", [](auto& f) { primitive_of(f)["mode"] = 6; }},
        {"a view that is not there", draco + "/bufferView", "out of range",
         [](auto& f) { draco_of(f)["bufferView"] = 1; }},
        {"other data", draco, "not Draco data", [](auto& f) { f.buffer[0] = std::byte{'d'}; }},
        {"an older version", draco, "version 2.1", [](auto& f) { f.buffer[6] = std::byte{1}; }},
        {"a cloud of points", draco, "not a triangle mesh", [](auto& f) { f.buffer[7] = std::byte{0}; }},
        {"an unknown method", draco, "unknown method 7", [](auto& f) { f.buffer[8] = std::byte{7}; }},
    };
    for (const Broken& defect : broken) {
        DYNAMIC_SECTION(defect.name) {
            auto file = test::draco_file(test::bumpy_sheet(1, 2), test::DracoSettings{});
            defect.inflict(file);
            const auto refusal = test::refusal_of(file);
            CHECK(refusal.pointer == defect.pointer);
            CHECK_THAT(refusal.message, Contains(defect.message));
        }
    }
}
