#include "tools/gallery/glb_writer.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/scenes.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstring>
#include <sstream>
#include <string>

using namespace gridreel::gallery;

namespace {

/// A .glb taken apart by hand.
struct Glb {
    std::uint32_t magic, version, length, json_length, json_type, binary_length, binary_type;
    nlohmann::json json;
    std::string binary;
};

std::uint32_t word(const std::string& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

Glb take_apart(const Document& document) {
    std::ostringstream out;
    write_glb(document, out);
    const std::string bytes = out.str();
    const std::size_t binary = 20 + word(bytes, 12);
    Glb glb{.magic = word(bytes, 0),
            .version = word(bytes, 4),
            .length = word(bytes, 8),
            .json_length = word(bytes, 12),
            .json_type = word(bytes, 16),
            .binary_length = word(bytes, binary),
            .binary_type = word(bytes, binary + 4),
            .json = nlohmann::json::parse(bytes.substr(20, word(bytes, 12))),
            .binary = bytes.substr(binary + 8)};
    CHECK(glb.length == bytes.size());
    return glb;
}

/// One triangle, shown once.
Document triangle() {
    Document document{.name = "one"};
    const Shape shape{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, -3}},
                      .normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
                      .triangles = {{0, 1, 2}}};
    const Id grey = append(document.materials, {.name = "grey", .base_color = {0.5, 0.5, 0.5}});
    add_mesh_node(document, "only", add_mesh(document, "one", shape, grey), {0, 1, 0});
    return document;
}

}  // namespace

TEST_CASE("a .glb has a header and two chunks padded to 4 bytes", "[gallery]") {
    const Glb glb = take_apart(triangle());
    CHECK(glb.magic == 0x46546C67);
    CHECK(glb.version == 2);
    CHECK(glb.json_type == 0x4E4F534A);
    CHECK(glb.binary_type == 0x004E4942);
    CHECK(glb.json_length % 4 == 0);
    CHECK(glb.binary_length % 4 == 0);
    CHECK(glb.binary.size() == glb.binary_length);
    CHECK(glb.json["buffers"][0]["byteLength"] == glb.binary_length);
}

TEST_CASE("three 16-bit indices take 6 bytes, and the buffer is padded to 8", "[gallery]") {
    const Glb glb = take_apart(triangle());
    // Positions 36, normals 36, indices 6.
    CHECK(glb.json["bufferViews"][2]["byteOffset"] == 72);
    CHECK(glb.json["bufferViews"][2]["byteLength"] == 6);
    CHECK(glb.json["bufferViews"][2]["target"] == 34963);
    CHECK(glb.binary_length == 80);
}

TEST_CASE("positions carry their bounds, and the file's numbers are the shape's", "[gallery]") {
    const Glb glb = take_apart(triangle());
    CHECK(glb.json["accessors"][0]["min"] == nlohmann::json({0.0, 0.0, -3.0}));
    CHECK(glb.json["accessors"][0]["max"] == nlohmann::json({1.0, 2.0, 0.0}));
    float z = 0.0f;
    std::memcpy(&z, glb.binary.data() + 32, sizeof z);
    CHECK(z == -3.0f);
    CHECK(glb.json["nodes"][0]["translation"] == nlohmann::json({0.0, 1.0, 0.0}));
}

TEST_CASE("nodes without a parent are the scene's roots", "[gallery]") {
    Document document = triangle();
    append(document.nodes, Node{.name = "parent", .children = {0}});
    CHECK(take_apart(document).json["scenes"][0]["nodes"] == nlohmann::json({1}));
}

TEST_CASE("indices become 32-bit where 65535 would be one of them", "[gallery]") {
    const std::vector<glm::uvec3> triangles{{0, 1, 2}};
    Document document;
    const Id narrow = add_indices(document, triangles, 65535);
    const Id wide = add_indices(document, triangles, 65536);
    CHECK(document.accessors[narrow].component == Component::u16);
    CHECK(document.accessors[narrow].bytes.size() == 6);
    CHECK(document.accessors[wide].component == Component::u32);
    CHECK(document.accessors[wide].bytes.size() == 12);
}

TEST_CASE("rotation keys take the shorter way from one to the next", "[gallery]") {
    // The second key is the first one's neighbour with its sign turned round.
    const std::vector<glm::dquat> keys{{1, 0, 0, 0}, {-0.8, 0, -0.6, 0}};
    Document document;
    const Id id = add_rotation_keys(document, keys);
    std::array<std::int16_t, 8> xyzw{};
    std::memcpy(xyzw.data(), document.accessors[id].bytes.data(), 16);
    CHECK(xyzw == std::array<std::int16_t, 8>{0, 0, 0, 32767, 0, 19660, 0, 26214});
}

TEST_CASE("every accessor and index of every scene is in range", "[gallery]") {
    for (const SceneMaker& scene : scene_makers) {
        INFO(scene.name);
        const Document document = scene.make(1);
        const Glb glb = take_apart(document);
        for (const auto& view : glb.json["bufferViews"]) {
            CHECK(view["byteOffset"].get<std::size_t>() % 4 == 0);
            CHECK(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>() <=
                  glb.binary_length);
        }
        for (const Mesh& mesh : document.meshes) {
            const std::size_t vertices = document.accessors[mesh.attributes.front().second].count;
            for (const auto& [semantic, id] : mesh.attributes)
                CHECK(document.accessors[id].count == vertices);
            const Accessor& indices = document.accessors[mesh.indices];
            REQUIRE(indices.component == Component::u16);
            std::vector<std::uint16_t> numbers(indices.count);
            std::memcpy(numbers.data(), indices.bytes.data(), indices.bytes.size());
            CHECK(*std::ranges::max_element(numbers) < vertices);
        }
    }
}
