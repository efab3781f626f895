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

constexpr std::string_view nodes_prefix = "/nodes/";

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
std::size_t count_of(const Place& root, std::string_view prefix) {
    std::optional<Place> place = root;
    std::string_view rest = prefix.substr(1);
    while (place && !rest.empty()) {
        const auto slash = rest.find('/');
        place = place->find(rest.substr(0, slash));
        rest = rest.substr(slash + 1);
    }
    return place ? place->size() : 0;
}

std::size_t count_of_weights(const Place& root, std::size_t node, const Place& target) {
    const auto mesh = root.at("nodes", node).find_index("mesh");
    const auto targets =
        mesh ? root.at("meshes", *mesh).at("primitives", 0).find("targets") : std::optional<Place>{};
    if (!targets || targets->size() == 0)
        target.refuse(
            fmt::format("morph weights are animated, but node {} has no mesh with morph targets", node));
    return targets->size();
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

    ChannelTarget weights = at(ChannelPath::weights, "SCALAR");
    weights.elements_per_key = count_of_weights(root, node, target);
    return weights;
}

/// What only pointers reach of a node: visibility and single weights.
std::optional<ChannelTarget> pointed_node_target(std::string_view property, std::size_t node,
                                                 const Place& target, const Place& root) {
    if (property == "extensions/KHR_node_visibility/visible")
        return ChannelTarget{
            .path = ChannelPath::visibility, .object = static_cast<Index>(node), .element = "SCALAR"};
    constexpr std::string_view weights = "weights/";
    if (!property.starts_with(weights)) return node_target(property, node, target, root);

    const auto weight = parse_number<std::size_t>(property.substr(weights.size()));
    const std::size_t count = count_of_weights(root, node, target);
    if (!weight || *weight >= count)
        target.refuse(
            fmt::format("\"{}\" is not one of the {} morph weights of node {}", property, count, node));
    return ChannelTarget{.path = ChannelPath::weight,
                         .object = static_cast<Index>(node),
                         .property = static_cast<Index>(*weight),
                         .element = "SCALAR"};
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
        found = pointed_node_target(pointed->property, pointed->number, target, root);
    for (const Family& family : families)
        if (const auto pointed = match(pointer, family.prefix, root))
            found = find_property(*pointed, family.path);
    if (!found) return {.target = {}, .ignored = text};
    found->by_pointer = true;
    return {.target = found, .ignored = {}};
}

}  // namespace

ResolvedTarget resolve_target(const Place& target, const Place& root) {
    const std::string& path = target.at("path").text();
    if (path == "pointer") {
        const auto extensions = target.find("extensions");
        const auto extension =
            extensions ? extensions->find("KHR_animation_pointer") : std::optional<Place>{};
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
