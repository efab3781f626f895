#include "anim/gltf/channel_target.h"

#include "anim/animated_properties.h"
#include "anim/parse_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace gridreel::anim::gltf {
namespace {

/// What all pointers to objects of one kind begin with, up to the object's number.
struct Family {
    std::string_view prefix;
    ChannelPath path;
};

constexpr std::array families{
    Family{"/cameras/", ChannelPath::camera},
    Family{"/extensions/KHR_lights_punctual/lights/", ChannelPath::light},
    Family{"/materials/", ChannelPath::material},
};

constexpr std::string_view nodes_prefix = "/nodes/", meshes_prefix = "/meshes/";
constexpr std::string_view weights_prefix = "weights/";

/// "12/translation": an object's number, and the property below it.
struct Numbered {
    std::size_t number = 0;
    std::string_view property;
};

std::optional<Numbered> split_number(std::string_view text) {
    const auto slash = text.find('/');
    if (slash == text.npos) return {};
    const auto number = parse_number<std::size_t>(text.substr(0, slash));
    if (!number) return {};
    return Numbered{.number = *number, .property = text.substr(slash + 1)};
}

/// The array that the prefix names, without its slashes at both ends.
std::optional<Place> array_of(const Place& root, std::string_view prefix) {
    std::optional<Place> place = root;
    std::string_view rest = prefix.substr(1);
    while (place && !rest.empty()) {
        const auto slash = rest.find('/');
        place = place->find(rest.substr(0, slash));
        rest = rest.substr(slash + 1);
    }
    return place;
}

std::size_t count_of(const Place& root, std::string_view prefix) {
    const auto array = array_of(root, prefix);
    return array ? array->size() : 0;
}

/// How many morph targets a mesh has.
std::size_t count_of_targets(const Place& root, std::size_t mesh) {
    return root.at("meshes", mesh).at("primitives", 0).count("targets");
}

std::size_t count_of_node_weights(const Place& root, std::size_t node, const Place& target) {
    const auto mesh = root.at("nodes", node).find_index("mesh");
    const std::size_t count = mesh ? count_of_targets(root, *mesh) : 0;
    if (count == 0)
        target.refuse(
            fmt::format("morph weights are animated, but node {} has no mesh with morph targets", node));
    return count;
}

std::size_t count_of_mesh_weights(const Place& root, std::size_t mesh, const Place& target) {
    const std::size_t count = count_of_targets(root, mesh);
    if (count == 0)
        target.refuse(fmt::format("morph weights are animated, but mesh {} has no morph targets", mesh));
    return count;
}

/// "weights" or "weights/1" of a node or a mesh that has `count` of them.
ChannelTarget weights_target(const Numbered& pointed, std::size_t count, const Place& target) {
    ChannelTarget found{.path = ChannelPath::weights,
                        .object = static_cast<Index>(pointed.number),
                        .element = "SCALAR",
                        .elements_per_key = count};
    if (pointed.property == "weights") return found;

    const auto weight = parse_number<std::size_t>(pointed.property.substr(weights_prefix.size()));
    if (!weight || *weight >= count)
        target.refuse(fmt::format("\"{}\" is not one of the {} morph weights", pointed.property, count));
    found.path = ChannelPath::weight;
    found.property = static_cast<Index>(*weight);
    found.elements_per_key = 1;
    return found;
}

/// A property of a node; nothing for paths that are not known.
std::optional<ChannelTarget> node_target(std::string_view path, std::size_t node, const Place& target,
                                         const Place& root) {
    const auto at = [&](ChannelPath kind, std::string_view element) {
        return ChannelTarget{.path = kind, .object = static_cast<Index>(node), .element = element};
    };
    if (path == "translation") return at(ChannelPath::translation, "VEC3");
    if (path == "rotation") return at(ChannelPath::rotation, "VEC4");
    if (path == "scale") return at(ChannelPath::scale, "VEC3");
    if (path != "weights") return {};
    return weights_target({.number = node, .property = path}, count_of_node_weights(root, node, target),
                          target);
}

bool is_about_weights(std::string_view property) {
    return property == "weights" || property.starts_with(weights_prefix);
}

/// What pointers reach of a node: more than paths do, visibility and single weights.
std::optional<ChannelTarget> pointed_node_target(const Numbered& pointed, const Place& target,
                                                 const Place& root) {
    if (pointed.property == "extensions/KHR_node_visibility/visible")
        return ChannelTarget{.path = ChannelPath::visibility,
                             .object = static_cast<Index>(pointed.number),
                             .element = "SCALAR"};
    if (is_about_weights(pointed.property))
        return weights_target(pointed, count_of_node_weights(root, pointed.number, target), target);
    return node_target(pointed.property, pointed.number, target, root);
}

std::optional<ChannelTarget> pointed_mesh_target(const Numbered& pointed, const Place& target,
                                                 const Place& root) {
    if (!is_about_weights(pointed.property)) return {};
    auto found = weights_target(pointed, count_of_mesh_weights(root, pointed.number, target), target);
    found.of_mesh = true;
    return found;
}

template <class Object>
std::optional<ChannelTarget> find_property(std::span<const AnimatedProperty<Object>> properties,
                                           const Numbered& pointed, ChannelPath path) {
    constexpr std::array<std::string_view, 4> elements{"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto found = std::find_if(
        properties.begin(), properties.end(),
        [&](const AnimatedProperty<Object>& property) { return property.pointer == pointed.property; });
    if (found == properties.end()) return {};
    return ChannelTarget{.path = path,
                         .object = static_cast<Index>(pointed.number),
                         .property = static_cast<Index>(found - properties.begin()),
                         .element = elements[found->width - 1]};
}

std::optional<ChannelTarget> find_property(const Numbered& pointed, ChannelPath path) {
    switch (path) {
        case ChannelPath::camera:
            return find_property(camera_properties(), pointed, path);
        case ChannelPath::light:
            return find_property(light_properties(), pointed, path);
        default:
            return find_property(material_properties(), pointed, path);
    }
}

/// Whether a camera or light is of the kind that the property belongs to: "perspective/znear" is nothing of
/// an orthographic one, whose own near plane it must not move.
bool is_of_its_kind(const Family& family, const Numbered& pointed, const Place& root) {
    const auto slash = pointed.property.find('/');
    if (family.path == ChannelPath::material || slash == pointed.property.npos) return true;
    const Place object = (*array_of(root, family.prefix))[pointed.number];
    return object.text_or("type", "") == pointed.property.substr(0, slash);
}

/// The object's number and what is pointed at in it, when the pointer begins with `prefix`.
std::optional<Numbered> match(const Place& pointer, std::string_view prefix, const Place& root) {
    const std::string_view text = pointer.text();
    if (!text.starts_with(prefix)) return {};
    const auto pointed = split_number(text.substr(prefix.size()));
    if (!pointed) pointer.refuse(fmt::format("\"{}\" does not name a property", text));
    const std::size_t count = count_of(root, prefix);
    if (pointed->number >= count)
        pointer.refuse(fmt::format("\"{}\" leads nowhere: the file has {} of these", text, count));
    return pointed;
}

ResolvedTarget resolve_pointer(const Place& pointer, const Place& target, const Place& root) {
    const std::string& text = pointer.text();
    if (!text.starts_with('/')) pointer.refuse(fmt::format("\"{}\" is not a JSON pointer", text));

    std::optional<ChannelTarget> found;
    if (const auto pointed = match(pointer, nodes_prefix, root))
        found = pointed_node_target(*pointed, target, root);
    if (const auto pointed = match(pointer, meshes_prefix, root))
        found = pointed_mesh_target(*pointed, target, root);
    for (const Family& family : families)
        if (const auto pointed = match(pointer, family.prefix, root))
            if (is_of_its_kind(family, *pointed, root)) found = find_property(*pointed, family.path);
    if (!found) return {.target = {}, .ignored = text};
    found->by_pointer = true;
    return {.target = found, .ignored = {}};
}

}  // namespace

ResolvedTarget resolve_target(const Place& target, const Place& root) {
    const std::string& path = target.at("path").text();
    if (path == "pointer") {
        const auto extension = target.find_extension("KHR_animation_pointer");
        if (extension) return resolve_pointer(extension->at("pointer"), target, root);
    }

    // A channel without a node, or on a path we do not know, plays nothing (section 3.11).
    const auto node = target.find_index("node");
    if (!node) return {};
    const auto found = node_target(path, *node, target, root);
    if (!found) return {.target = {}, .ignored = path};
    return {.target = found, .ignored = {}};
}

}  // namespace gridreel::anim::gltf
