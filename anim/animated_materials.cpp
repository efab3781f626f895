#include "anim/animated_properties.h"

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace gridreel::anim {
namespace {

using Property = AnimatedProperty<Material>;

// --- Factors -----------------------------------------------------------------------------------

/// In [0, 1].
template <auto number>
void set_share(Material& material, const float* value) {
    number(material) = std::clamp(value[0], 0.0f, 1.0f);
}

template <auto number>
void set_not_negative(Material& material, const float* value) {
    number(material) = std::max(value[0], 0.0f);
}

template <auto number>
void set_above_zero(Material& material, const float* value) {
    number(material) = std::max(value[0], std::numeric_limits<float>::min());
}

template <auto number>
void set_number(Material& material, const float* value) {
    number(material) = value[0];
}

template <auto color>
void set_color(Material& material, const float* value) {
    color(material) = glm::max(glm::vec3(glm::make_vec3(value)), glm::vec3(0.0f));
}

void set_base_color(Material& material, const float* value) {
    material.base_color = glm::clamp(glm::vec4(glm::make_vec4(value)), 0.0f, 1.0f);
}

/// Zero, which reflects everything, or at least that of a vacuum.
void set_ior(Material& material, const float* value) {
    material.ior = value[0] <= 0.0f ? 0.0f : std::max(value[0], 1.0f);
}

/// What `member` is in a material.
#define GRIDREEL_OF(member) ([](Material & material) -> auto& { return material.member; })

std::vector<Property> factors() {
    return {
        {"pbrMetallicRoughness/baseColorFactor", 4, set_base_color},
        {"pbrMetallicRoughness/metallicFactor", 1, set_share<GRIDREEL_OF(metallic)>},
        {"pbrMetallicRoughness/roughnessFactor", 1, set_share<GRIDREEL_OF(roughness)>},
        {"emissiveFactor", 3, set_color<GRIDREEL_OF(emissive)>},
        {"alphaCutoff", 1, set_not_negative<GRIDREEL_OF(alpha_cutoff)>},
        {"normalTexture/scale", 1, set_number<GRIDREEL_OF(normal_scale)>},
        {"occlusionTexture/strength", 1, set_share<GRIDREEL_OF(occlusion_strength)>},
        {"extensions/KHR_materials_emissive_strength/emissiveStrength", 1,
         set_not_negative<GRIDREEL_OF(emissive_strength)>},
        {"extensions/KHR_materials_ior/ior", 1, set_ior},
        {"extensions/KHR_materials_specular/specularFactor", 1, set_share<GRIDREEL_OF(specular.factor)>},
        {"extensions/KHR_materials_specular/specularColorFactor", 3, set_color<GRIDREEL_OF(specular.color)>},
        {"extensions/KHR_materials_clearcoat/clearcoatFactor", 1, set_share<GRIDREEL_OF(clearcoat.factor)>},
        {"extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", 1,
         set_share<GRIDREEL_OF(clearcoat.roughness)>},
        {"extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", 1,
         set_number<GRIDREEL_OF(clearcoat.normal_scale)>},
        {"extensions/KHR_materials_sheen/sheenColorFactor", 3, set_color<GRIDREEL_OF(sheen.color)>},
        {"extensions/KHR_materials_sheen/sheenRoughnessFactor", 1, set_share<GRIDREEL_OF(sheen.roughness)>},
        {"extensions/KHR_materials_transmission/transmissionFactor", 1,
         set_share<GRIDREEL_OF(transmission.factor)>},
        {"extensions/KHR_materials_volume/thicknessFactor", 1,
         set_not_negative<GRIDREEL_OF(volume.thickness_m)>},
        {"extensions/KHR_materials_volume/attenuationDistance", 1,
         set_above_zero<GRIDREEL_OF(volume.attenuation_distance_m)>},
        {"extensions/KHR_materials_volume/attenuationColor", 3,
         set_color<GRIDREEL_OF(volume.attenuation_color)>},
    };
}

// --- Texture transforms ------------------------------------------------------------------------

template <auto slot>
void set_offset(Material& material, const float* value) {
    if (slot(material)) slot(material)->transform.offset = {value[0], value[1]};
}

template <auto slot>
void set_rotation(Material& material, const float* value) {
    if (slot(material)) slot(material)->transform.rotation_rad = value[0];
}

template <auto slot>
void set_scale(Material& material, const float* value) {
    if (slot(material)) slot(material)->transform.scale = {value[0], value[1]};
}

/// KHR_texture_transform of the texture that the file names `texture`.
template <auto slot>
void add_transform(std::vector<Property>& properties, std::string_view texture) {
    const auto pointer = [&](std::string_view property) {
        return fmt::format("{}/extensions/KHR_texture_transform/{}", texture, property);
    };
    properties.push_back({pointer("offset"), 2, set_offset<slot>});
    properties.push_back({pointer("rotation"), 1, set_rotation<slot>});
    properties.push_back({pointer("scale"), 2, set_scale<slot>});
}

std::vector<Property> all_properties() {
    std::vector<Property> all = factors();
    add_transform<GRIDREEL_OF(base_color_texture)>(all, "pbrMetallicRoughness/baseColorTexture");
    add_transform<GRIDREEL_OF(metallic_roughness_texture)>(all,
                                                           "pbrMetallicRoughness/metallicRoughnessTexture");
    add_transform<GRIDREEL_OF(normal_texture)>(all, "normalTexture");
    add_transform<GRIDREEL_OF(occlusion_texture)>(all, "occlusionTexture");
    add_transform<GRIDREEL_OF(emissive_texture)>(all, "emissiveTexture");
    add_transform<GRIDREEL_OF(specular.texture)>(all, "extensions/KHR_materials_specular/specularTexture");
    add_transform<GRIDREEL_OF(specular.color_texture)>(
        all, "extensions/KHR_materials_specular/specularColorTexture");
    add_transform<GRIDREEL_OF(clearcoat.texture)>(all, "extensions/KHR_materials_clearcoat/clearcoatTexture");
    add_transform<GRIDREEL_OF(clearcoat.roughness_texture)>(
        all, "extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture");
    add_transform<GRIDREEL_OF(clearcoat.normal_texture)>(
        all, "extensions/KHR_materials_clearcoat/clearcoatNormalTexture");
    add_transform<GRIDREEL_OF(sheen.color_texture)>(all, "extensions/KHR_materials_sheen/sheenColorTexture");
    add_transform<GRIDREEL_OF(sheen.roughness_texture)>(
        all, "extensions/KHR_materials_sheen/sheenRoughnessTexture");
    add_transform<GRIDREEL_OF(transmission.texture)>(
        all, "extensions/KHR_materials_transmission/transmissionTexture");
    add_transform<GRIDREEL_OF(volume.thickness_texture)>(all,
                                                         "extensions/KHR_materials_volume/thicknessTexture");
    return all;
}

#undef GRIDREEL_OF

}  // namespace

std::span<const Property> material_properties() {
    static const std::vector<Property> all = all_properties();
    return all;
}

}  // namespace gridreel::anim
