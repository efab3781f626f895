#include "anim/gltf/read_animations.h"

#include "anim/gltf/channel_target.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>

namespace gridreel::anim::gltf {
namespace {

Interpolation interpolation_named(std::string_view name) {
    if (name == "STEP") return Interpolation::step;
    return name == "CUBICSPLINE" ? Interpolation::cubic_spline : Interpolation::linear;
}

std::vector<float> read_times(Document& document, const Place& place) {
    auto times = document.floats(place.index(), place);
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i]) || times[i] < 0.0f)
            place.refuse(fmt::format("key {} is at {} s; times are finite and not negative", i, times[i]));
        if (i > 0 && times[i] <= times[i - 1])
            place.refuse(fmt::format("key {} at {} s does not come after key {} at {} s", i, times[i], i - 1,
                                     times[i - 1]),
                         "remove the repeated key or export the animation again");
    }
    return times;
}

/// Rotations of length zero have no direction to turn to.
void check_rotations(const Sampler& sampler, const Place& place) {
    const bool is_cubic = sampler.interpolation == Interpolation::cubic_spline;
    const std::size_t first = is_cubic ? 4 : 0, step = is_cubic ? 12 : 4;
    for (std::size_t i = first; i < sampler.values.size(); i += step) {
        const auto key = std::span(sampler.values).subspan(i, 4);
        if (std::all_of(key.begin(), key.end(), [](float value) { return value == 0.0f; }))
            place.refuse(fmt::format("the rotation of key {} is a quaternion of length zero", i / step));
    }
}

/// What the file calls the target.
std::string target_name(const Place& target) {
    const auto pointer = target.find_extension("KHR_animation_pointer");
    if (pointer) return pointer->at("pointer").text();
    return fmt::format("/nodes/{}/{}", target.at("node").index(), target.at("path").text());
}

Sampler read_sampler(Document& document, const Place& place) {
    Sampler sampler;
    sampler.interpolation = interpolation_named(place.text_or("interpolation", "LINEAR"));
    sampler.times_s = read_times(document, place.at("input"));

    const Place output = place.at("output");
    sampler.values = document.floats(output.index(), output);
    for (const float value : sampler.values)
        if (!std::isfinite(value)) output.refuse(fmt::format("a key value is {}", value));
    const std::size_t per_key = sampler.interpolation == Interpolation::cubic_spline ? 3 : 1;
    sampler.width = static_cast<std::uint32_t>(sampler.values.size() / (sampler.times_s.size() * per_key));
    return sampler;
}

/// The channels of one animation as they are read: what they drive, and what there is to warn of.
struct Channels {
    std::map<std::size_t, Index> kept;  ///< the file's sampler -> ours
    std::set<std::tuple<bool, ChannelPath, Index, Index>> driven;
    std::map<Index, std::vector<Index>> weighted_by;  ///< a mesh -> those nodes
    std::set<std::string> ignored, repeated, blended_flags;
};

/// The nodes that have a mesh and state no weights of their own (section 3.7.4).
std::vector<Index> nodes_weighted_by(Document& document, Index mesh) {
    std::vector<Index> nodes;
    const auto places = document.all("nodes");
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Place& node = places[i];
        const auto weights = node.find("weights");
        const bool has_own = weights && weights->size() > 0;
        if (node.find_index("mesh") == mesh && !has_own) nodes.push_back(static_cast<Index>(i));
    }
    return nodes;
}

void read_channel(Document& document, const Place& channel, const Place& samplers, Channels& channels,
                  Animation& animation) {
    const Place place = channel.at("target");
    const ResolvedTarget resolved = resolve_target(place, document.root());
    if (!resolved.ignored.empty()) channels.ignored.insert(resolved.ignored);
    if (!resolved.target) return;
    const ChannelTarget& target = *resolved.target;

    const std::size_t sampler = channel.at("sampler").integer();
    const auto [entry, is_new] =
        channels.kept.emplace(sampler, static_cast<Index>(animation.samplers.size()));
    if (is_new) animation.samplers.push_back(read_sampler(document, samplers[sampler]));
    if (target.path == ChannelPath::rotation)
        check_rotations(animation.samplers[entry->second], samplers[sampler].at("output"));
    Channel driving{.object = target.object,
                    .path = target.path,
                    .property = target.property,
                    .sampler = entry->second,
                    .of_mesh = target.of_mesh};
    if (target.of_mesh) {
        auto [nodes, is_first] = channels.weighted_by.try_emplace(target.object);
        if (is_first) nodes->second = nodes_weighted_by(document, target.object);
        document.budget().spend(nodes->second.size() * sizeof(Channel), place);
        for (const Index node : nodes->second) {
            driving.object = node;
            animation.channels.push_back(driving);
        }
    } else {
        animation.channels.push_back(driving);
    }

    if (!channels.driven.emplace(target.of_mesh, target.path, target.object, target.property).second)
        channels.repeated.insert(target_name(place));
    if (target.path == ChannelPath::visibility &&
        animation.samplers[entry->second].interpolation != Interpolation::step)
        channels.blended_flags.insert(target_name(place));
}

Animation read_animation(Document& document, const Place& place) {
    Animation animation;
    animation.name = place.text_or("name", "");
    Channels channels;
    const Place list = place.at("channels");
    for (std::size_t i = 0; i < list.size(); ++i)
        read_channel(document, list[i], place.at("samplers"), channels, animation);

    if (!channels.ignored.empty())
        document.warn(place,
                      fmt::format("what these channels animate is not supported, and stays as it is: {}",
                                  fmt::join(channels.ignored, ", ")));
    if (!channels.repeated.empty())
        document.warn(place, fmt::format("animated more than once, of which the last counts: {}",
                                         fmt::join(channels.repeated, ", ")));
    if (!channels.blended_flags.empty())
        document.warn(place, fmt::format("a flag cannot be blended; it changes at its keys: {}",
                                         fmt::join(channels.blended_flags, ", ")));
    return animation;
}

}  // namespace

std::vector<Animation> read_animations(Document& document) {
    std::vector<Animation> animations;
    for (const Place& place : document.all("animations"))
        animations.push_back(read_animation(document, place));
    return animations;
}

}  // namespace gridreel::anim::gltf
