#include "anim/gltf/validate.h"

#include <fmt/format.h>

#include <set>
#include <utility>

namespace gridreel::anim::gltf {
namespace {

/// Components of one key on a path, as elements and how many of them; elements empty for unknown paths.
struct Expected {
    std::string_view element;
    std::size_t elements_per_key = 1;
};

Expected expected_output(const Place& target, const Place& root) {
    const std::string& path = target.at("path").text();
    if (path == "translation" || path == "scale") return {.element = "VEC3"};
    if (path == "rotation") return {.element = "VEC4"};
    if (path != "weights") return {};

    const std::size_t node = target.at("node").index();
    const auto mesh = root.at("nodes", node).find_index("mesh");
    const auto targets =
        mesh ? root.at("meshes", *mesh).at("primitives", 0).find("targets") : std::optional<Place>{};
    if (!targets || targets->size() == 0)
        target.refuse(
            fmt::format("morph weights are animated, but node {} has no mesh with morph targets", node));
    return {.element = "SCALAR", .elements_per_key = targets->size()};
}

void check_input(const Place& sampler, std::span<const Accessor> accessors) {
    const Place place = sampler.at("input");
    const Accessor& input = accessors[place.index()];
    if (!input.is("SCALAR") || !input.is_float())
        place.refuse(fmt::format("key times are {} of {}; they must be SCALAR of FLOAT", input.element.name,
                                 name_of(input.component)));
    if (sampler.text_or("interpolation", "LINEAR") == "CUBICSPLINE" && input.count < 2)
        place.refuse("a cubic spline needs at least two keys");
}

void check_output(const Place& sampler, const Expected& expected, std::span<const Accessor> accessors) {
    const Place place = sampler.at("output");
    const Accessor& output = accessors[place.index()];
    if (!output.is(expected.element))
        place.refuse(
            fmt::format("key values are {}; this path needs {}", output.element.name, expected.element));

    const bool may_be_integer = expected.element != "VEC3";
    const bool is_integer = output.normalized;
    if (!output.is_float() && !(may_be_integer && is_integer))
        place.refuse(fmt::format("key values are {} of {}; this path needs {}", output.element.name,
                                 name_of(output.component),
                                 may_be_integer ? "FLOAT or normalized integers" : "FLOAT"));

    const std::size_t keys = accessors[sampler.at("input").index()].count;
    const std::size_t per_key = sampler.text_or("interpolation", "LINEAR") == "CUBICSPLINE" ? 3 : 1;
    const std::size_t needed = keys * per_key * expected.elements_per_key;
    if (output.count != needed)
        place.refuse(fmt::format("there are {} key values; {} keys need {}", output.count, keys, needed));
}

void check_channel(const Place& channel, const Place& samplers, const Place& root,
                   std::span<const Accessor> accessors) {
    const Place sampler_place = channel.at("sampler");
    const std::size_t sampler_index = sampler_place.integer();
    if (sampler_index >= samplers.size())
        sampler_place.refuse(fmt::format("index {} is out of range: the animation has {} samplers",
                                         sampler_index, samplers.size()));

    // A channel without a node, or on a path we do not know, plays nothing (section 3.11).
    const Place target = channel.at("target");
    if (!target.has("node")) return;
    const Expected expected = expected_output(target, root);
    if (expected.element.empty()) return;

    const std::size_t node = target.at("node").index();
    if (expected.element != "SCALAR" && root.at("nodes", node).has("matrix"))
        target.refuse(fmt::format("the {} of node {} is animated, but the node has a matrix",
                                  target.at("path").text(), node),
                      "export the node with translation, rotation and scale");
    check_output(samplers[sampler_index], expected, accessors);
}

}  // namespace

void validate_animations(const Place& root, std::span<const Accessor> accessors) {
    const auto animations = root.find("animations");
    for (std::size_t a = 0; animations && a < animations->size(); ++a) {
        const Place samplers = (*animations)[a].at("samplers"), channels = (*animations)[a].at("channels");
        for (std::size_t s = 0; s < samplers.size(); ++s) check_input(samplers[s], accessors);

        std::set<std::pair<std::size_t, std::string>> animated;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            check_channel(channels[c], samplers, root, accessors);
            const Place target = channels[c].at("target");
            const auto node = target.find_index("node");
            if (node && !animated.emplace(*node, target.at("path").text()).second)
                target.refuse(fmt::format("the {} of node {} is animated twice in one animation",
                                          target.at("path").text(), *node));
        }
    }
}

}  // namespace gridreel::anim::gltf
