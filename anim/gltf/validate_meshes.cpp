#include "anim/gltf/extensions.h"
#include "anim/gltf/validate.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gridreel::anim::gltf {
namespace {

using enum ComponentType;

/// One way an attribute may be stored.
struct Format {
    ComponentType component;
    bool normalized = false;
    bool needs_quantization = false;  ///< only where KHR_mesh_quantization is listed
};

struct AttributeRule {
    std::string_view name;  ///< up to the set's number
    std::vector<std::string_view> elements;
    std::vector<Format> formats;
};

/// Section 3.7.2.1 and the tables of KHR_mesh_quantization. Attributes not named here are not read.
const std::vector<AttributeRule>& attribute_rules() {
    static const std::vector<AttributeRule> rules{
        {.name = "POSITION",
         .elements = {"VEC3"},
         .formats = {{float32},
                     {int8, false, true},
                     {int8, true, true},
                     {uint8, false, true},
                     {uint8, true, true},
                     {int16, false, true},
                     {int16, true, true},
                     {uint16, false, true},
                     {uint16, true, true}}},
        {.name = "NORMAL",
         .elements = {"VEC3"},
         .formats = {{float32}, {int8, true, true}, {int16, true, true}}},
        {.name = "TANGENT",
         .elements = {"VEC4"},
         .formats = {{float32}, {int8, true, true}, {int16, true, true}}},
        {.name = "TEXCOORD",
         .elements = {"VEC2"},
         .formats = {{float32},
                     {uint8, true},
                     {uint16, true},
                     {int8, false, true},
                     {int8, true, true},
                     {uint8, false, true},
                     {int16, false, true},
                     {int16, true, true},
                     {uint16, false, true}}},
        {.name = "COLOR",
         .elements = {"VEC3", "VEC4"},
         .formats = {{float32}, {uint8, true}, {uint16, true}}},
        {.name = "JOINTS", .elements = {"VEC4"}, .formats = {{uint8}, {uint16}}},
        {.name = "WEIGHTS", .elements = {"VEC4"}, .formats = {{float32}, {uint8, true}, {uint16, true}}},
    };
    return rules;
}

const std::vector<AttributeRule>& target_rules() {
    static const std::vector<Format> displacement{
        {float32}, {int8, false, true}, {int8, true, true}, {int16, false, true}, {int16, true, true}};
    static const std::vector<AttributeRule> rules{
        {.name = "POSITION", .elements = {"VEC3"}, .formats = displacement},
        {.name = "NORMAL",
         .elements = {"VEC3"},
         .formats = {{float32}, {int8, true, true}, {int16, true, true}}},
        {.name = "TANGENT",
         .elements = {"VEC3"},
         .formats = {{float32}, {int8, true, true}, {int16, true, true}}},
    };
    return rules;
}

std::string describe(const Accessor& accessor) {
    return fmt::format("{} of {}{}", accessor.element.name, accessor.normalized ? "normalized " : "",
                       name_of(accessor.component));
}

void check_attribute(const Place& place, std::string_view name, const Accessor& accessor,
                     const std::vector<AttributeRule>& rules, bool quantized) {
    const auto base = name.substr(0, name.find('_'));
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const auto& r) { return r.name == base; });
    if (rule == rules.end()) return;

    if (std::find(rule->elements.begin(), rule->elements.end(), accessor.element.name) ==
        rule->elements.end())
        place.refuse(fmt::format("{} is {}; it must be {}", name, describe(accessor),
                                 fmt::join(rule->elements, " or ")));
    const auto format = std::find_if(rule->formats.begin(), rule->formats.end(), [&](const Format& f) {
        return f.component == accessor.component && f.normalized == accessor.normalized;
    });
    if (format == rule->formats.end())
        place.refuse(fmt::format("{} cannot be stored as {}", name, describe(accessor)));
    if (format->needs_quantization && !quantized)
        place.refuse(fmt::format("{} is {}, which needs KHR_mesh_quantization", name, describe(accessor)),
                     "list the extension, or export with float attributes");
}

/// JOINTS_n and WEIGHTS_n come in pairs, numbered from 0 without gaps.
void check_influence_sets(const Place& attributes) {
    std::size_t joints = 0, weights = 0;
    for (const auto& [name, value] : std::get<Json::Object>(attributes.json().value)) {
        if (name.starts_with("JOINTS_")) ++joints;
        if (name.starts_with("WEIGHTS_")) ++weights;
    }
    for (std::size_t set = 0; set < std::max(joints, weights); ++set)
        for (const auto base : {"JOINTS", "WEIGHTS"})
            if (const auto name = fmt::format("{}_{}", base, set); !attributes.has(name))
                attributes.refuse(
                    fmt::format("{} is missing: JOINTS_n and WEIGHTS_n come in pairs from 0", name));
}

void check_indices(const Place& place, const Accessor& accessor) {
    const bool is_unsigned =
        accessor.component == uint8 || accessor.component == uint16 || accessor.component == uint32;
    if (!accessor.is("SCALAR") || !is_unsigned || accessor.normalized)
        place.refuse(
            fmt::format("indices are {}; they must be SCALAR of unsigned integers", describe(accessor)));
}

void check_primitive(const Place& primitive, std::span<const Accessor> accessors, bool quantized) {
    const Place attributes = primitive.at("attributes");
    std::optional<std::size_t> vertex_count;
    const auto check_all = [&](const Place& map, const std::vector<AttributeRule>& rules) {
        for (const auto& [name, value] : std::get<Json::Object>(map.json().value)) {
            const Place place = map.at(name);
            const Accessor& accessor = accessors[place.index()];
            if (!vertex_count) vertex_count = accessor.count;
            if (accessor.count != *vertex_count)
                place.refuse(fmt::format("{} has {} elements; the primitive has {} vertices", name,
                                         accessor.count, *vertex_count));
            check_attribute(place, name, accessor, rules, quantized);
        }
    };

    check_all(attributes, attribute_rules());
    check_influence_sets(attributes);
    if (const auto indices = primitive.find("indices")) check_indices(*indices, accessors[indices->index()]);
    if (const auto targets = primitive.find("targets"))
        for (std::size_t i = 0; i < targets->size(); ++i) check_all((*targets)[i], target_rules());
}

}  // namespace

void validate_meshes(const Place& root, std::span<const Accessor> accessors) {
    const bool quantized = lists_extension(root, "KHR_mesh_quantization");
    const auto meshes = root.find("meshes");
    for (std::size_t m = 0; meshes && m < meshes->size(); ++m) {
        const Place mesh = (*meshes)[m], primitives = mesh.at("primitives");
        const std::size_t targets = primitives[0].count("targets");
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            check_primitive(primitives[p], accessors, quantized);
            if (primitives[p].count("targets") != targets)
                primitives[p].refuse(
                    fmt::format("the primitive has {} morph targets, the mesh's first has {}",
                                primitives[p].count("targets"), targets));
        }
        if (const auto weights = mesh.find("weights");
            weights && weights->size() > 0 && weights->size() != targets)
            weights->refuse(
                fmt::format("the mesh has {} morph weights for {} targets", weights->size(), targets));
    }
}

}  // namespace gridreel::anim::gltf
