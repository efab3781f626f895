#include "anim/gltf/read_materials.h"

#include <fmt/format.h>

namespace gridreel::anim::gltf {
namespace {

// --- Values ------------------------------------------------------------------------------------

float float_or(const Place& owner, std::string_view name, float otherwise) {
    return static_cast<float>(owner.number_or(name, double(otherwise)));
}

template <class Vector>
Vector vector_or(const Place& owner, std::string_view name, const Vector& otherwise) {
    const auto list = owner.find(name);
    if (!list) return otherwise;
    Vector vector{};
    for (int i = 0; i < Vector::length(); ++i)
        vector[i] = static_cast<float>((*list)[static_cast<std::size_t>(i)].number());
    return vector;
}

// --- Textures ----------------------------------------------------------------------------------

TextureTransform read_transform(const Place& place) {
    constexpr TextureTransform none;
    return {.offset = vector_or(place, "offset", none.offset),
            .rotation_rad = float_or(place, "rotation", none.rotation_rad),
            .scale = vector_or(place, "scale", none.scale)};
}

std::optional<TextureRef> read_ref(Document& document, const Place& owner, std::string_view slot) {
    const auto place = owner.find(slot);
    if (!place) return {};
    TextureRef ref{.texture = place->at("index").index()};
    std::size_t set = place->integer_or("texCoord", 0);
    if (const auto transform = place->find_extension("KHR_texture_transform")) {
        ref.transform = read_transform(*transform);
        set = transform->integer_or("texCoord", set);
    }
    if (set > 1) {
        document.warn(*place,
                      fmt::format("texture {} uses TEXCOORD_{}; only 0 and 1 are read, so it is left out",
                                  ref.texture, set));
        return {};
    }
    ref.texcoord = static_cast<std::uint32_t>(set);
    return ref;
}

/// A property of the reference itself, as the scale of a normal map is.
float of_ref(const Place& owner, std::string_view slot, std::string_view name, float otherwise) {
    const auto place = owner.find(slot);
    return place ? float_or(*place, name, otherwise) : otherwise;
}

// --- Extensions --------------------------------------------------------------------------------

float read_ior(Document& document, const Place& place, float otherwise) {
    const float ior = float_or(place, "ior", otherwise);
    if (ior == 0.0f || ior >= 1.0f) return ior;
    document.warn(place, fmt::format("an index of refraction is 0 or at least 1: {} is read as 1", ior));
    return 1.0f;
}

Specular read_specular(Document& document, const Place& place) {
    constexpr Specular none;
    return {.factor = float_or(place, "specularFactor", none.factor),
            .texture = read_ref(document, place, "specularTexture"),
            .color = vector_or(place, "specularColorFactor", none.color),
            .color_texture = read_ref(document, place, "specularColorTexture")};
}

Clearcoat read_clearcoat(Document& document, const Place& place) {
    constexpr Clearcoat none;
    return {.factor = float_or(place, "clearcoatFactor", none.factor),
            .texture = read_ref(document, place, "clearcoatTexture"),
            .roughness = float_or(place, "clearcoatRoughnessFactor", none.roughness),
            .roughness_texture = read_ref(document, place, "clearcoatRoughnessTexture"),
            .normal_texture = read_ref(document, place, "clearcoatNormalTexture"),
            .normal_scale = of_ref(place, "clearcoatNormalTexture", "scale", none.normal_scale)};
}

Sheen read_sheen(Document& document, const Place& place) {
    constexpr Sheen none;
    return {.color = vector_or(place, "sheenColorFactor", none.color),
            .color_texture = read_ref(document, place, "sheenColorTexture"),
            .roughness = float_or(place, "sheenRoughnessFactor", none.roughness),
            .roughness_texture = read_ref(document, place, "sheenRoughnessTexture")};
}

Transmission read_transmission(Document& document, const Place& place) {
    constexpr Transmission none;
    return {.factor = float_or(place, "transmissionFactor", none.factor),
            .texture = read_ref(document, place, "transmissionTexture")};
}

Volume read_volume(Document& document, const Place& place) {
    constexpr Volume none;
    return {.thickness_m = float_or(place, "thicknessFactor", none.thickness_m),
            .thickness_texture = read_ref(document, place, "thicknessTexture"),
            .attenuation_distance_m = float_or(place, "attenuationDistance", none.attenuation_distance_m),
            .attenuation_color = vector_or(place, "attenuationColor", none.attenuation_color)};
}

void read_extensions(Document& document, const Place& place, Material& material) {
    material.unlit = place.find_extension("KHR_materials_unlit").has_value();
    if (const auto strength = place.find_extension("KHR_materials_emissive_strength"))
        material.emissive_strength = float_or(*strength, "emissiveStrength", material.emissive_strength);
    if (const auto ior = place.find_extension("KHR_materials_ior"))
        material.ior = read_ior(document, *ior, material.ior);
    if (const auto specular = place.find_extension("KHR_materials_specular"))
        material.specular = read_specular(document, *specular);
    if (const auto clearcoat = place.find_extension("KHR_materials_clearcoat"))
        material.clearcoat = read_clearcoat(document, *clearcoat);
    if (const auto sheen = place.find_extension("KHR_materials_sheen"))
        material.sheen = read_sheen(document, *sheen);
    if (const auto transmission = place.find_extension("KHR_materials_transmission"))
        material.transmission = read_transmission(document, *transmission);
    if (const auto volume = place.find_extension("KHR_materials_volume"))
        material.volume = read_volume(document, *volume);
}

// --- The core ----------------------------------------------------------------------------------

void read_metallic_roughness(Document& document, const Place& place, Material& material) {
    material.base_color = vector_or(place, "baseColorFactor", material.base_color);
    material.base_color_texture = read_ref(document, place, "baseColorTexture");
    material.metallic = float_or(place, "metallicFactor", material.metallic);
    material.roughness = float_or(place, "roughnessFactor", material.roughness);
    material.metallic_roughness_texture = read_ref(document, place, "metallicRoughnessTexture");
}

AlphaMode read_alpha_mode(const Place& place) {
    const std::string mode = place.text_or("alphaMode", "OPAQUE");
    return mode == "MASK" ? AlphaMode::mask : mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
}

Material read_material(Document& document, const Place& place) {
    Material material;
    material.name = place.text_or("name", "");
    if (const auto pbr = place.find("pbrMetallicRoughness"))
        read_metallic_roughness(document, *pbr, material);
    material.emissive = vector_or(place, "emissiveFactor", material.emissive);
    material.emissive_texture = read_ref(document, place, "emissiveTexture");
    material.normal_texture = read_ref(document, place, "normalTexture");
    material.normal_scale = of_ref(place, "normalTexture", "scale", material.normal_scale);
    material.occlusion_texture = read_ref(document, place, "occlusionTexture");
    material.occlusion_strength = of_ref(place, "occlusionTexture", "strength", material.occlusion_strength);
    material.alpha_mode = read_alpha_mode(place);
    material.alpha_cutoff = float_or(place, "alphaCutoff", material.alpha_cutoff);
    material.double_sided = place.boolean_or("doubleSided", false);
    read_extensions(document, place, material);
    return material;
}

}  // namespace

std::vector<Material> read_materials(Document& document) {
    std::vector<Material> materials;
    for (const Place& place : document.all("materials")) materials.push_back(read_material(document, place));
    return materials;
}

}  // namespace gridreel::anim::gltf
