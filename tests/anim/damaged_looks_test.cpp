#include "anim/drawn_textures.h"
#include "anim/error.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace gridreel;
using nlohmann::json;

namespace {

/// A triangle with every look there is.
test::GltfBuilder dressed_triangle() {
    auto file = test::one_triangle();
    const json moved{{"index", 0},
                     {"texCoord", 1},
                     {"extensions",
                      {{"KHR_texture_transform",
                        {{"offset", {0, 1}}, {"rotation", 1}, {"scale", {1, 2}}, {"texCoord", 0}}}}}};
    json normal = moved;
    normal["scale"] = 0.5;
    json occlusion = moved;
    occlusion["strength"] = 0.5;
    const json image{{"uri", "data:image/png;base64,AAAA"}, {"mimeType", "image/png"}};
    file.json["images"] = {image, image};
    file.json["samplers"] = {{{"magFilter", 9728}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33648}}};
    file.json["textures"] = {
        {{"source", 0},
         {"sampler", 0},
         {"extensions", {{"EXT_texture_webp", {{"source", 1}}}, {"KHR_texture_basisu", {{"source", 1}}}}}}};
    file.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {1, 1, 1, 1}},
           {"baseColorTexture", moved},
           {"metallicFactor", 0.5},
           {"roughnessFactor", 0.5},
           {"metallicRoughnessTexture", moved}}},
         {"normalTexture", normal},
         {"occlusionTexture", occlusion},
         {"emissiveTexture", moved},
         {"emissiveFactor", {1, 1, 1}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.5},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}},
           {"KHR_materials_ior", {{"ior", 1.3}}},
           {"KHR_materials_specular",
            {{"specularFactor", 0.5}, {"specularTexture", moved}, {"specularColorFactor", {1, 1, 1}}}},
           {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}, {"clearcoatNormalTexture", normal}}},
           {"KHR_materials_sheen", {{"sheenColorFactor", {1, 1, 1}}, {"sheenRoughnessFactor", 0.5}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.5}, {"transmissionTexture", moved}}},
           {"KHR_materials_volume",
            {{"thicknessFactor", 1}, {"attenuationDistance", 1}, {"attenuationColor", {1, 1, 1}}}}}}}};
    file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "day"}}};
    json& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 0}, {"variants", {0}}}};
    return file;
}

/// Pointers to every value below `place`, and to itself.
void list_pointers(const json& value, const std::string& pointer, std::vector<std::string>& pointers) {
    pointers.push_back(pointer);
    if (!value.is_structured()) return;
    for (const auto& item : value.items()) list_pointers(item.value(), pointer + "/" + item.key(), pointers);
}

/// Whatever loads keeps what `Scene` promises.
void check_promises(const anim::Scene& scene) {
    for (const anim::Texture& texture : scene.textures)
        CHECK(texture.image.value_or(0) < scene.images.size());
    for (const anim::Material& material : scene.materials) {
        for (const anim::DrawnTexture& texture : anim::drawn_textures(material)) {
            CHECK(texture.ref.texture < scene.textures.size());
            CHECK(texture.ref.texcoord < 2);
            CHECK(std::isfinite(texture.ref.transform.rotation_rad));
        }
        CHECK(std::isfinite(material.emissive_strength));
        CHECK((material.ior == 0.0f || material.ior >= 1.0f));
        CHECK(material.volume.attenuation_distance_m > 0.0f);
    }
    for (const anim::Primitive& primitive : scene.meshes.at(0).primitives)
        for (const anim::VariantMaterial& look : primitive.variant_materials) {
            CHECK(look.variant < scene.variants.size());
            CHECK(look.material < scene.materials.size());
        }
}

}  // namespace

TEST_CASE("any value of a look replaced by any other is refused inside its place or kept in bounds",
          "[load][validate]") {
    const auto whole = dressed_triangle();
    check_promises(whole.load());
    const json replacements = {
        nullptr, true,          -1, 0, 0.5, 7, 1e9, 1e39, 1e300, "x", "2.0", json::array(), json::object(),
        {1},     {{"index", 9}}};
    std::size_t refused = 0, kept = 0;
    for (const char* const section : {"materials", "textures", "samplers", "extensions", "meshes"}) {
        std::vector<std::string> pointers;
        list_pointers(whole.json[section], std::string("/") + section, pointers);
        for (const std::string& pointer : pointers) {
            for (const json& replacement : replacements) {
                auto file = whole;
                file.json[json::json_pointer(pointer)] = replacement;
                INFO(pointer << " = " << replacement);
                try {
                    check_promises(file.load());
                    ++kept;
                } catch (const Error& error) {
                    // Somewhere in the file, and with something to do about it.
                    CHECK(error.where().starts_with("test.gltf: /"));
                    CHECK_FALSE(error.remedy().empty());
                    ++refused;
                }
            }
        }
    }
    CHECK(refused > kept);
    CHECK(kept > 100);
}
