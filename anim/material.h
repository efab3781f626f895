#pragma once
// What a surface looks like, as a glTF file says it.

#include "anim/index.h"
#include "anim/texture_transform.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace gridreel::anim {

struct TextureRef {
    Index texture = 0;
    std::uint32_t texcoord = 0;  ///< 0 or 1
    TextureTransform transform{};
};

/// KHR_materials_clearcoat.
struct Clearcoat {
    float factor = 0.0f;                ///< 0: none
    std::optional<TextureRef> texture;  ///< R
    float roughness = 0.0f;
    std::optional<TextureRef> roughness_texture;  ///< G
    std::optional<TextureRef> normal_texture;
    float normal_scale = 1.0f;
};

/// KHR_materials_sheen.
struct Sheen {
    glm::vec3 color{0.0f};                    ///< linear RGB; black: none
    std::optional<TextureRef> color_texture;  ///< sRGB
    float roughness = 0.0f;
    std::optional<TextureRef> roughness_texture;  ///< A
};

/// KHR_materials_specular: of the dielectric part.
struct Specular {
    float factor = 1.0f;
    std::optional<TextureRef> texture;        ///< A
    glm::vec3 color{1.0f};                    ///< linear RGB, may exceed 1
    std::optional<TextureRef> color_texture;  ///< sRGB
};

/// KHR_materials_transmission.
struct Transmission {
    float factor = 0.0f;                ///< 0: none
    std::optional<TextureRef> texture;  ///< R
};

/// KHR_materials_volume.
struct Volume {
    float thickness_m = 0.0f;                     ///< in the mesh's space; 0: the surface is a thin wall
    std::optional<TextureRef> thickness_texture;  ///< G
    float attenuation_distance_m = std::numeric_limits<float>::infinity();
    glm::vec3 attenuation_color{1.0f};  ///< linear RGB
};

enum class AlphaMode { opaque, mask, blend };

/// Every look that is read. What is read but not drawn yet is warned of (`warn_of_undrawn_looks`).
struct Material {
    std::string name;
    bool unlit = false;          ///< KHR_materials_unlit: the base colour, whatever the light
    glm::vec4 base_color{1.0f};  ///< linear RGBA factor
    std::optional<TextureRef> base_color_texture;  ///< sRGB
    float metallic = 1.0f;
    float roughness = 1.0f;
    std::optional<TextureRef> metallic_roughness_texture;  ///< B metallic, G roughness
    glm::vec3 emissive{0.0f};
    float emissive_strength = 1.0f;              ///< KHR_materials_emissive_strength: multiplies `emissive`
    std::optional<TextureRef> emissive_texture;  ///< sRGB
    std::optional<TextureRef> normal_texture;
    float normal_scale = 1.0f;
    std::optional<TextureRef> occlusion_texture;  ///< R
    float occlusion_strength = 1.0f;
    float ior = 1.5f;  ///< KHR_materials_ior; 0 (reflects everything) or >= 1
    Specular specular{};
    Clearcoat clearcoat{};
    Sheen sheen{};
    Transmission transmission{};
    Volume volume{};
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;
};

}  // namespace gridreel::anim
