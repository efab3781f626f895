#include "anim/gltf/schema.h"

#include <array>

// What surfaces look like: glTF 2.0, sections 3.8 and 3.9, and the schemas of the extensions to materials and
// textures.

namespace gridreel::anim::gltf {
namespace {

using enum Kind;

constexpr Length two{.least = 2, .most = 2};
constexpr Length three{.least = 3, .most = 3};
constexpr Length four{.least = 4, .most = 4};

constexpr int highest_set = 65535;  // of texture coordinates; those beyond 1 are warned of later

// --- Where a material refers to a texture ------------------------------------------------------

constexpr Property texture_transform_properties[] = {
    {.name = "offset", .kind = number, .list = true, .length = two},
    {.name = "rotation", .kind = number},
    {.name = "scale", .kind = number, .list = true, .length = two},
    {.name = "texCoord", .kind = integer, .most = highest_set},
};
constexpr Shape texture_transform{texture_transform_properties};

constexpr Property texture_info_extension_properties[] = {
    {.name = "KHR_texture_transform", .kind = object, .shape = &texture_transform},
};
constexpr Shape texture_info_extensions{texture_info_extension_properties};

constexpr Property texture_index{.name = "index", .kind = index, .required = true, .into = "textures"};
constexpr Property texcoord_set{.name = "texCoord", .kind = integer, .most = highest_set};
constexpr Property texture_info_extras{
    .name = "extensions", .kind = object, .shape = &texture_info_extensions};

constexpr Property texture_info_properties[] = {texture_index, texcoord_set, texture_info_extras};
constexpr Shape texture_info{texture_info_properties};

constexpr Property normal_texture_properties[] = {
    texture_index, texcoord_set, texture_info_extras, {.name = "scale", .kind = number}};
constexpr Shape normal_texture{normal_texture_properties};

constexpr Property occlusion_texture_properties[] = {
    texture_index,
    texcoord_set,
    texture_info_extras,
    {.name = "strength", .kind = number, .least = 0, .most = 1}};
constexpr Shape occlusion_texture{occlusion_texture_properties};

// --- Extensions to materials -------------------------------------------------------------------

constexpr Shape unlit{};

constexpr Property emissive_strength_properties[] = {
    {.name = "emissiveStrength", .kind = number, .least = 0},
};
constexpr Shape emissive_strength{emissive_strength_properties};

constexpr Property ior_properties[] = {
    {.name = "ior", .kind = number, .least = 0},
};
constexpr Shape ior{ior_properties};

constexpr Property specular_properties[] = {
    {.name = "specularFactor", .kind = number, .least = 0, .most = 1},
    {.name = "specularTexture", .kind = object, .shape = &texture_info},
    {.name = "specularColorFactor", .kind = number, .list = true, .length = three, .least = 0},
    {.name = "specularColorTexture", .kind = object, .shape = &texture_info},
};
constexpr Shape specular{specular_properties};

constexpr Property clearcoat_properties[] = {
    {.name = "clearcoatFactor", .kind = number, .least = 0, .most = 1},
    {.name = "clearcoatTexture", .kind = object, .shape = &texture_info},
    {.name = "clearcoatRoughnessFactor", .kind = number, .least = 0, .most = 1},
    {.name = "clearcoatRoughnessTexture", .kind = object, .shape = &texture_info},
    {.name = "clearcoatNormalTexture", .kind = object, .shape = &normal_texture},
};
constexpr Shape clearcoat{clearcoat_properties};

constexpr Property sheen_properties[] = {
    {.name = "sheenColorFactor", .kind = number, .list = true, .length = three, .least = 0, .most = 1},
    {.name = "sheenColorTexture", .kind = object, .shape = &texture_info},
    {.name = "sheenRoughnessFactor", .kind = number, .least = 0, .most = 1},
    {.name = "sheenRoughnessTexture", .kind = object, .shape = &texture_info},
};
constexpr Shape sheen{sheen_properties};

constexpr Property transmission_properties[] = {
    {.name = "transmissionFactor", .kind = number, .least = 0, .most = 1},
    {.name = "transmissionTexture", .kind = object, .shape = &texture_info},
};
constexpr Shape transmission{transmission_properties};

constexpr Property volume_properties[] = {
    {.name = "thicknessFactor", .kind = number, .least = 0},
    {.name = "thicknessTexture", .kind = object, .shape = &texture_info},
    {.name = "attenuationDistance", .kind = number, .least = 0, .above_least = true},
    {.name = "attenuationColor", .kind = number, .list = true, .length = three, .least = 0, .most = 1},
};
constexpr Shape volume{volume_properties};

constexpr Property material_extension_properties[] = {
    {.name = "KHR_materials_unlit", .kind = object, .shape = &unlit},
    {.name = "KHR_materials_emissive_strength", .kind = object, .shape = &emissive_strength},
    {.name = "KHR_materials_ior", .kind = object, .shape = &ior},
    {.name = "KHR_materials_specular", .kind = object, .shape = &specular},
    {.name = "KHR_materials_clearcoat", .kind = object, .shape = &clearcoat},
    {.name = "KHR_materials_sheen", .kind = object, .shape = &sheen},
    {.name = "KHR_materials_transmission", .kind = object, .shape = &transmission},
    {.name = "KHR_materials_volume", .kind = object, .shape = &volume},
};
constexpr Shape material_extensions{material_extension_properties};

// --- Materials ---------------------------------------------------------------------------------

constexpr Property metallic_roughness_properties[] = {
    {.name = "baseColorFactor", .kind = number, .list = true, .length = four, .least = 0, .most = 1},
    {.name = "baseColorTexture", .kind = object, .shape = &texture_info},
    {.name = "metallicFactor", .kind = number, .least = 0, .most = 1},
    {.name = "roughnessFactor", .kind = number, .least = 0, .most = 1},
    {.name = "metallicRoughnessTexture", .kind = object, .shape = &texture_info},
};
constexpr Shape metallic_roughness{metallic_roughness_properties};

constexpr std::array<std::string_view, 3> alpha_modes{"OPAQUE", "MASK", "BLEND"};

constexpr Property material_properties[] = {
    {.name = "pbrMetallicRoughness", .kind = object, .shape = &metallic_roughness},
    {.name = "normalTexture", .kind = object, .shape = &normal_texture},
    {.name = "occlusionTexture", .kind = object, .shape = &occlusion_texture},
    {.name = "emissiveTexture", .kind = object, .shape = &texture_info},
    {.name = "emissiveFactor", .kind = number, .list = true, .length = three, .least = 0},
    {.name = "alphaMode", .kind = text, .words = alpha_modes},
    {.name = "alphaCutoff", .kind = number, .least = 0},
    {.name = "doubleSided", .kind = boolean},
    {.name = "extensions", .kind = object, .shape = &material_extensions},
};

// --- Textures ----------------------------------------------------------------------------------

constexpr std::array mag_filters{9728, 9729};
constexpr std::array min_filters{9728, 9729, 9984, 9985, 9986, 9987};
constexpr std::array wraps{10497, 33071, 33648};

constexpr Property texture_sampler_properties[] = {
    {.name = "magFilter", .kind = integer, .codes = mag_filters},
    {.name = "minFilter", .kind = integer, .codes = min_filters},
    {.name = "wrapS", .kind = integer, .codes = wraps},
    {.name = "wrapT", .kind = integer, .codes = wraps},
};

constexpr Property other_source_properties[] = {
    {.name = "source", .kind = index, .into = "images"},
};
constexpr Shape other_source{other_source_properties};

constexpr Property texture_extension_properties[] = {
    {.name = "EXT_texture_webp", .kind = object, .shape = &other_source},
    {.name = "KHR_texture_basisu", .kind = object, .shape = &other_source},
};
constexpr Shape texture_extensions{texture_extension_properties};

constexpr Property texture_properties[] = {
    {.name = "sampler", .kind = index, .into = "samplers"},
    {.name = "source", .kind = index, .into = "images"},
    {.name = "extensions", .kind = object, .shape = &texture_extensions},
};

constexpr Property image_properties[] = {
    {.name = "uri", .kind = text},
    {.name = "mimeType", .kind = text},
    {.name = "bufferView", .kind = index, .into = "bufferViews"},
};

}  // namespace

constinit const Shape material_shape{material_properties};
constinit const Shape texture_shape{texture_properties};
constinit const Shape texture_sampler_shape{texture_sampler_properties};
constinit const Shape image_shape{image_properties};

}  // namespace gridreel::anim::gltf
