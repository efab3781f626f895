#include "anim/gltf/schema.h"

#include <array>

namespace gridreel::anim::gltf {
namespace {

using enum Kind;

constexpr double any_integer = 9007199254740992.0;  // 2^53
constexpr double pi = 3.14159265358979323846;
constexpr Length one{.least = 1};

constexpr Length exactly(std::size_t count) {
    return {.least = count, .most = count};
}

// --- Bytes -------------------------------------------------------------------------------------

constexpr std::array component_types{5120, 5121, 5122, 5123, 5125, 5126};
constexpr std::array index_component_types{5121, 5123, 5125};
constexpr std::array<std::string_view, 7> element_types{"SCALAR", "VEC2", "VEC3", "VEC4",
                                                        "MAT2",   "MAT3", "MAT4"};

constexpr Property fallback_properties[] = {
    {.name = "fallback", .kind = boolean},
};
constexpr Shape fallback{fallback_properties};

constexpr Property buffer_extension_properties[] = {
    {.name = "EXT_meshopt_compression", .kind = object, .shape = &fallback},
    {.name = "KHR_meshopt_compression", .kind = object, .shape = &fallback},
};
constexpr Shape buffer_extensions{buffer_extension_properties};

constexpr Property buffer_properties[] = {
    {.name = "uri", .kind = text},
    {.name = "byteLength", .kind = integer, .required = true, .most = any_integer},
    {.name = "extensions", .kind = object, .shape = &buffer_extensions},
};
constexpr Shape buffer{buffer_properties};

constexpr std::array<std::string_view, 3> meshopt_modes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 5> meshopt_filters{"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL",
                                                          "COLOR"};

constexpr Property meshopt_properties[] = {
    {.name = "buffer", .kind = index, .required = true, .into = "buffers"},
    {.name = "byteOffset", .kind = integer, .most = any_integer},
    {.name = "byteLength", .kind = integer, .required = true, .least = 1, .most = any_integer},
    {.name = "byteStride", .kind = integer, .required = true, .least = 1, .most = 256},
    {.name = "count", .kind = integer, .required = true, .least = 1, .most = any_integer},
    {.name = "mode", .kind = text, .required = true, .words = meshopt_modes},
    {.name = "filter", .kind = text, .words = meshopt_filters},
};
constexpr Shape meshopt{meshopt_properties};

constexpr Property view_extension_properties[] = {
    {.name = "EXT_meshopt_compression", .kind = object, .shape = &meshopt},
    {.name = "KHR_meshopt_compression", .kind = object, .shape = &meshopt},
};
constexpr Shape view_extensions{view_extension_properties};

constexpr Property view_properties[] = {
    {.name = "buffer", .kind = index, .required = true, .into = "buffers"},
    {.name = "byteOffset", .kind = integer, .most = any_integer},
    {.name = "byteLength", .kind = integer, .required = true, .most = any_integer},
    {.name = "byteStride", .kind = integer, .least = 4, .most = 252},
    {.name = "extensions", .kind = object, .shape = &view_extensions},
};
constexpr Shape view{view_properties};

constexpr Property sparse_index_properties[] = {
    {.name = "bufferView", .kind = index, .required = true, .into = "bufferViews"},
    {.name = "byteOffset", .kind = integer, .most = any_integer},
    {.name = "componentType", .kind = integer, .required = true, .codes = index_component_types},
};
constexpr Shape sparse_indices{sparse_index_properties};

constexpr Property sparse_value_properties[] = {
    {.name = "bufferView", .kind = index, .required = true, .into = "bufferViews"},
    {.name = "byteOffset", .kind = integer, .most = any_integer},
};
constexpr Shape sparse_values{sparse_value_properties};

constexpr Property sparse_properties[] = {
    {.name = "count", .kind = integer, .required = true, .least = 1, .most = any_integer},
    {.name = "indices", .kind = object, .required = true, .shape = &sparse_indices},
    {.name = "values", .kind = object, .required = true, .shape = &sparse_values},
};
constexpr Shape sparse{sparse_properties};

constexpr Property accessor_properties[] = {
    {.name = "bufferView", .kind = index, .into = "bufferViews"},
    {.name = "byteOffset", .kind = integer, .most = any_integer},
    {.name = "componentType", .kind = integer, .required = true, .codes = component_types},
    {.name = "normalized", .kind = boolean},
    {.name = "count", .kind = integer, .required = true, .least = 1, .most = any_integer},
    {.name = "type", .kind = text, .required = true, .words = element_types},
    {.name = "sparse", .kind = object, .shape = &sparse},
};
constexpr Shape accessor{accessor_properties};

// --- Nodes -------------------------------------------------------------------------------------

constexpr Property light_reference_properties[] = {
    {.name = "light", .kind = index, .required = true, .into = "lights"},
};
constexpr Shape light_reference{light_reference_properties};

constexpr Property visibility_properties[] = {
    {.name = "visible", .kind = boolean},
};
constexpr Shape visibility{visibility_properties};

constexpr Property instancing_properties[] = {
    {.name = "attributes", .kind = index_map, .into = "accessors"},
};
constexpr Shape instancing{instancing_properties};

constexpr Property node_extension_properties[] = {
    {.name = "KHR_node_visibility", .kind = object, .shape = &visibility},
    {.name = "EXT_mesh_gpu_instancing", .kind = object, .shape = &instancing},
    {.name = "KHR_lights_punctual", .kind = object, .shape = &light_reference},
};
constexpr Shape node_extensions{node_extension_properties};

constexpr Property node_properties[] = {
    {.name = "camera", .kind = index, .into = "cameras"},
    {.name = "children", .kind = index, .list = true, .into = "nodes"},
    {.name = "skin", .kind = index, .into = "skins"},
    {.name = "matrix", .kind = number, .list = true, .length = exactly(16)},
    {.name = "mesh", .kind = index, .into = "meshes"},
    {.name = "rotation", .kind = number, .list = true, .length = exactly(4)},
    {.name = "scale", .kind = number, .list = true, .length = exactly(3)},
    {.name = "translation", .kind = number, .list = true, .length = exactly(3)},
    {.name = "weights", .kind = number, .list = true},
    {.name = "extensions", .kind = object, .shape = &node_extensions},
};
constexpr Shape node{node_properties};

constexpr Property scene_properties[] = {
    {.name = "nodes", .kind = index, .list = true, .into = "nodes"},
};
constexpr Shape scene{scene_properties};

constexpr Property skin_properties[] = {
    {.name = "inverseBindMatrices", .kind = index, .into = "accessors"},
    {.name = "skeleton", .kind = index, .into = "nodes"},
    {.name = "joints", .kind = index, .required = true, .list = true, .length = one, .into = "nodes"},
};
constexpr Shape skin{skin_properties};

// --- Meshes ------------------------------------------------------------------------------------

constexpr std::array modes{0, 1, 2, 3, 4, 5, 6};

// The names and identifiers in `attributes` are checked where they are looked up.
constexpr Shape draco_attributes{};
constexpr Property draco_properties[] = {
    {.name = "bufferView", .kind = index, .required = true, .into = "bufferViews"},
    {.name = "attributes", .kind = object, .required = true, .shape = &draco_attributes},
};
constexpr Shape draco{draco_properties};

constexpr Property variant_mapping_properties[] = {
    {.name = "variants", .kind = index, .required = true, .list = true, .length = one, .into = "variants"},
    {.name = "material", .kind = index, .required = true, .into = "materials"},
};
constexpr Shape variant_mapping{variant_mapping_properties};

constexpr Property variant_mappings_properties[] = {
    {.name = "mappings", .kind = object, .required = true, .list = true, .shape = &variant_mapping},
};
constexpr Shape variant_mappings{variant_mappings_properties};

constexpr Property primitive_extension_properties[] = {
    {.name = "KHR_draco_mesh_compression", .kind = object, .shape = &draco},
    {.name = "KHR_materials_variants", .kind = object, .shape = &variant_mappings},
};
constexpr Shape primitive_extensions{primitive_extension_properties};

constexpr Property primitive_properties[] = {
    {.name = "attributes", .kind = index_map, .required = true, .into = "accessors"},
    {.name = "indices", .kind = index, .into = "accessors"},
    {.name = "material", .kind = index, .into = "materials"},
    {.name = "mode", .kind = integer, .codes = modes},
    {.name = "targets", .kind = index_map, .list = true, .into = "accessors"},
    {.name = "extensions", .kind = object, .shape = &primitive_extensions},
};
constexpr Shape primitive{primitive_properties};

constexpr Property mesh_properties[] = {
    {.name = "primitives",
     .kind = object,
     .required = true,
     .list = true,
     .length = one,
     .shape = &primitive},
    {.name = "weights", .kind = number, .list = true},
};
constexpr Shape mesh{mesh_properties};

// --- Animations --------------------------------------------------------------------------------

constexpr std::array<std::string_view, 3> interpolations{"LINEAR", "STEP", "CUBICSPLINE"};

constexpr Property animation_sampler_properties[] = {
    {.name = "input", .kind = index, .required = true, .into = "accessors"},
    {.name = "interpolation", .kind = text, .words = interpolations},
    {.name = "output", .kind = index, .required = true, .into = "accessors"},
};
constexpr Shape animation_sampler{animation_sampler_properties};

constexpr Property animation_pointer_properties[] = {
    {.name = "pointer", .kind = text, .required = true},
};
constexpr Shape animation_pointer{animation_pointer_properties};

constexpr Property target_extension_properties[] = {
    {.name = "KHR_animation_pointer", .kind = object, .shape = &animation_pointer},
};
constexpr Shape target_extensions{target_extension_properties};

constexpr Property target_properties[] = {
    {.name = "node", .kind = index, .into = "nodes"},
    {.name = "path", .kind = text, .required = true},
    {.name = "extensions", .kind = object, .shape = &target_extensions},
};
constexpr Shape target{target_properties};

// A channel's sampler is an index into its own animation: validate_animations checks it.
constexpr Property channel_properties[] = {
    {.name = "sampler", .kind = integer, .required = true, .most = any_integer},
    {.name = "target", .kind = object, .required = true, .shape = &target},
};
constexpr Shape channel{channel_properties};

constexpr Property animation_properties[] = {
    {.name = "channels", .kind = object, .required = true, .list = true, .shape = &channel},
    {.name = "samplers", .kind = object, .required = true, .list = true, .shape = &animation_sampler},
};
constexpr Shape animation{animation_properties};

// --- Cameras and lights
// -------------------------------------------------------------------------------------

constexpr std::array<std::string_view, 2> camera_types{"perspective", "orthographic"};

constexpr Property perspective_properties[] = {
    {.name = "aspectRatio", .kind = number, .least = 0, .above_least = true},
    {.name = "yfov", .kind = number, .required = true, .least = 0, .most = pi, .above_least = true},
    {.name = "zfar", .kind = number, .least = 0, .above_least = true},
    {.name = "znear", .kind = number, .required = true, .least = 0, .above_least = true},
};
constexpr Shape perspective{perspective_properties};

constexpr Property orthographic_properties[] = {
    {.name = "xmag", .kind = number, .required = true},
    {.name = "ymag", .kind = number, .required = true},
    {.name = "zfar", .kind = number, .required = true, .least = 0, .above_least = true},
    {.name = "znear", .kind = number, .required = true, .least = 0},
};
constexpr Shape orthographic{orthographic_properties};

constexpr Property camera_properties[] = {
    {.name = "type", .kind = text, .required = true, .words = camera_types},
    {.name = "perspective", .kind = object, .shape = &perspective},
    {.name = "orthographic", .kind = object, .shape = &orthographic},
};
constexpr Shape camera{camera_properties};

constexpr std::array<std::string_view, 3> light_types{"directional", "point", "spot"};

// Exporters write pi / 2 in single precision, which is a little more.
constexpr double quarter_turn = pi / 2 + 1e-6;

constexpr Property spot_properties[] = {
    {.name = "innerConeAngle", .kind = number, .least = 0, .most = quarter_turn},
    {.name = "outerConeAngle", .kind = number, .least = 0, .most = quarter_turn, .above_least = true},
};
constexpr Shape spot{spot_properties};

constexpr Property light_properties[] = {
    {.name = "type", .kind = text, .required = true, .words = light_types},
    {.name = "color", .kind = number, .list = true, .length = exactly(3), .least = 0},
    {.name = "intensity", .kind = number, .least = 0},
    {.name = "range", .kind = number, .least = 0, .above_least = true},
    {.name = "spot", .kind = object, .shape = &spot},
};
constexpr Shape light{light_properties};

// --- The file ----------------------------------------------------------------------------------

constexpr Property asset_properties[] = {
    {.name = "version", .kind = text, .required = true},
    {.name = "minVersion", .kind = text},
};
constexpr Shape asset{asset_properties};

constexpr Property lights_properties[] = {
    {.name = "lights", .kind = object, .required = true, .list = true, .shape = &light},
};
constexpr Shape lights{lights_properties};

constexpr Property variant_properties[] = {
    {.name = "name", .kind = text, .required = true},
};
constexpr Shape variant{variant_properties};

constexpr Property variants_properties[] = {
    {.name = "variants", .kind = object, .required = true, .list = true, .shape = &variant},
};
constexpr Shape variants{variants_properties};

constexpr Property root_extension_properties[] = {
    {.name = "KHR_lights_punctual", .kind = object, .shape = &lights},
    {.name = "KHR_materials_variants", .kind = object, .shape = &variants},
};
constexpr Shape root_extensions{root_extension_properties};

constexpr Property root_properties[] = {
    {.name = "asset", .kind = object, .required = true, .shape = &asset},
    {.name = "extensionsUsed", .kind = text, .list = true},
    {.name = "extensionsRequired", .kind = text, .list = true},
    {.name = "extensions", .kind = object, .shape = &root_extensions},
    {.name = "buffers", .kind = object, .list = true, .shape = &buffer},
    {.name = "bufferViews", .kind = object, .list = true, .shape = &view},
    {.name = "accessors", .kind = object, .list = true, .shape = &accessor},
    {.name = "nodes", .kind = object, .list = true, .shape = &node},
    {.name = "scenes", .kind = object, .list = true, .shape = &scene},
    {.name = "scene", .kind = index, .into = "scenes"},
    {.name = "skins", .kind = object, .list = true, .shape = &skin},
    {.name = "meshes", .kind = object, .list = true, .shape = &mesh},
    {.name = "animations", .kind = object, .list = true, .shape = &animation},
    {.name = "cameras", .kind = object, .list = true, .shape = &camera},
    {.name = "materials", .kind = object, .list = true, .shape = &material_shape},
    {.name = "samplers", .kind = object, .list = true, .shape = &texture_sampler_shape},
    {.name = "textures", .kind = object, .list = true, .shape = &texture_shape},
    {.name = "images", .kind = object, .list = true, .shape = &image_shape},
};
constexpr Shape root{root_properties};

}  // namespace

const Shape& root_shape() {
    return root;
}

}  // namespace gridreel::anim::gltf
