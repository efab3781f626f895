#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using nlohmann::json;

namespace {

/// A triangle with TEXCOORD_0 alone, whose material is `material`.
test::GltfBuilder triangle_with(const json& material) {
    auto file = test::one_triangle();
    const auto texcoords = file.add_accessor<float>({0, 0, 1, 0, 0, 1}, test::float32, "VEC2", 3);
    file.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    file.json["textures"] = {{{"source", 0}}};
    file.json["materials"] = json::array({material});
    json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = texcoords;
    primitive["material"] = 0;
    return file;
}

std::string warning_of(const json& material) {
    return test::warning_at(triangle_with(material).load(), "/meshes/0");
}

}  // namespace

TEST_CASE("a drawn texture on coordinates that a primitive lacks is warned of", "[load]") {
    const json first{{"index", 0}};
    const json second{{"index", 0}, {"texCoord", 1}};
    const json moved{{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}}}}}};
    const std::string lacking =
        "1 primitive is without the texture coordinates that its material asks for; the texture shows one "
        "colour everywhere";
    CHECK(warning_of({{"emissiveTexture", first}}).empty());
    CHECK(warning_of({{"emissiveTexture", second}}) == lacking);
    CHECK(warning_of({{"emissiveTexture", moved}}) == lacking);
    CHECK(warning_of({{"emissiveTexture", second}, {"extensions", {{"KHR_materials_unlit", json::object()}}}})
              .empty());
    CHECK(warning_of({{"normalTexture", second}}).empty());  // not drawn
}

TEST_CASE("coordinates that only a variant's material asks for count, too", "[load]") {
    auto file = triangle_with(json::object());
    file.json["materials"].push_back({{"emissiveTexture", {{"index", 0}, {"texCoord", 1}}}});
    file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
    json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}};
    file.json["meshes"][0]["primitives"].push_back(primitive);
    CHECK(test::warning_at(file.load(), "/meshes/0").starts_with("2 primitives are without"));
}
