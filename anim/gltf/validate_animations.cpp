#include "anim/gltf/channel_target.h"
#include "anim/gltf/validate.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <utility>

namespace gridreel::anim::gltf {
namespace {

void check_input(const Place& sampler, std::span<const Accessor> accessors) {
    const Place place = sampler.at("input");
    const Accessor& input = accessors[place.index()];
    if (!input.is("SCALAR") || !input.is_float())
        place.refuse(fmt::format("key times are {} of {}; they must be SCALAR of FLOAT", input.element.name,
                                 name_of(input.component)));
    if (sampler.text_or("interpolation", "LINEAR") == "CUBICSPLINE" && input.count < 2)
        place.refuse("a cubic spline needs at least two keys");
}

void check_output(const Place& sampler, const ChannelTarget& target, std::span<const Accessor> accessors) {
    const Place place = sampler.at("output");
    const Accessor& output = accessors[place.index()];
    if (!output.is(target.element))
        place.refuse(
            fmt::format("key values are {}; this path needs {}", output.element.name, target.element));

    const bool may_be_normalized = target.element != "VEC3";
    const bool fits = output.is_float() || target.by_pointer || (may_be_normalized && output.normalized);
    if (!fits)
        place.refuse(fmt::format("key values are {} of {}; this path needs {}", output.element.name,
                                 name_of(output.component),
                                 may_be_normalized ? "FLOAT or normalized integers" : "FLOAT"));

    const std::size_t keys = accessors[sampler.at("input").index()].count;
    const std::size_t per_key = sampler.text_or("interpolation", "LINEAR") == "CUBICSPLINE" ? 3 : 1;
    const std::size_t needed = keys * per_key * target.elements_per_key;
    if (output.count != needed)
        place.refuse(fmt::format("there are {} key values; {} keys need {}", output.count, keys, needed));
}

bool is_transform(ChannelPath path) {
    return path == ChannelPath::translation || path == ChannelPath::rotation || path == ChannelPath::scale;
}

/// What the channel drives, if it is anything that is drawn.
std::optional<ChannelTarget> check_channel(const Place& channel, const Place& samplers, const Place& root,
                                           std::span<const Accessor> accessors) {
    const Place sampler_place = channel.at("sampler");
    const std::size_t sampler_index = sampler_place.integer();
    if (sampler_index >= samplers.size())
        sampler_place.refuse(fmt::format("index {} is out of range: the animation has {} samplers",
                                         sampler_index, samplers.size()));

    const Place place = channel.at("target");
    const auto target = resolve_target(place, root).target;
    if (!target) return {};
    if (is_transform(target->path) && root.at("nodes", target->object).has("matrix"))
        place.refuse(
            fmt::format("the transform of node {} is animated, but the node has a matrix", target->object),
            "export the node with translation, rotation and scale");
    check_output(samplers[sampler_index], *target, accessors);
    return target;
}

}  // namespace

void validate_animations(const Place& root, std::span<const Accessor> accessors) {
    const auto animations = root.find("animations");
    for (std::size_t a = 0; animations && a < animations->size(); ++a) {
        const Place samplers = (*animations)[a].at("samplers"), channels = (*animations)[a].at("channels");
        for (std::size_t s = 0; s < samplers.size(); ++s) check_input(samplers[s], accessors);

        // Exporters do repeat pointers; `read_animations` warns of that.
        std::set<std::pair<ChannelPath, Index>> animated;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto target = check_channel(channels[c], samplers, root, accessors);
            if (!target || target->by_pointer) continue;
            const Place place = channels[c].at("target");
            if (!animated.emplace(target->path, target->object).second)
                place.refuse(fmt::format("the {} of node {} is animated twice in one animation",
                                         place.at("path").text(), target->object));
        }
    }
}

}  // namespace gridreel::anim::gltf
