#include "anim/gltf/read_animations.h"

#include "anim/gltf/channel_target.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
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
    std::set<Index> turning;  ///< samplers whose rotations have been checked
    std::set<std::string> ignored, repeated, blended_flags;

    /// Notes what is driven; false when it, or a part of it, was driven before.
    bool drives(const ChannelTarget& target) {
        // All weights of a node and one of them are no two properties.
        const auto is_driven = [&](ChannelPath path) {
            const auto found = driven.lower_bound({target.of_mesh, path, target.object, 0});
            return found != driven.end() && std::get<0>(*found) == target.of_mesh &&
                   std::get<1>(*found) == path && std::get<2>(*found) == target.object;
        };
        const bool overlaps = (target.path == ChannelPath::weight && is_driven(ChannelPath::weights)) ||
                              (target.path == ChannelPath::weights && is_driven(ChannelPath::weight));
        return driven.emplace(target.of_mesh, target.path, target.object, target.property).second &&
               !overlaps;
    }
};

/// The nodes that take their weights from each mesh, because they state none of their own (section 3.7.4).
std::map<Index, std::vector<Index>> nodes_by_mesh(const Document& document) {
    std::map<Index, std::vector<Index>> nodes;
    const auto places = document.all("nodes");
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto mesh = places[i].find_index("mesh");
        const auto weights = places[i].find("weights");
        const bool has_own = weights && weights->size() > 0;
        if (mesh && !has_own) nodes[static_cast<Index>(*mesh)].push_back(static_cast<Index>(i));
    }
    return nodes;
}

void read_channel(Document& document, const Place& channel, const Place& samplers,
                  const std::map<Index, std::vector<Index>>& weighted_by, Channels& channels,
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
    if (target.path == ChannelPath::rotation && channels.turning.insert(entry->second).second)
        check_rotations(animation.samplers[entry->second], samplers[sampler].at("output"));
    Channel driving{.object = target.object,
                    .path = target.path,
                    .property = target.property,
                    .sampler = entry->second,
                    .of_mesh = target.of_mesh};
    if (target.of_mesh) {
        const auto found = weighted_by.find(target.object);
        const auto nodes = found == weighted_by.end() ? std::span<const Index>() : std::span(found->second);
        document.budget().spend(nodes.size() * sizeof(Channel), place);
        for (const Index node : nodes) {
            driving.object = node;
            animation.channels.push_back(driving);
        }
    } else {
        animation.channels.push_back(driving);
    }

    if (!channels.drives(target)) channels.repeated.insert(target_name(place));
    if (target.path == ChannelPath::visibility &&
        animation.samplers[entry->second].interpolation != Interpolation::step)
        channels.blended_flags.insert(target_name(place));
}

Animation read_animation(Document& document, const Place& place,
                         const std::map<Index, std::vector<Index>>& weighted_by) {
    Animation animation;
    animation.name = place.text_or("name", "");
    Channels channels;
    const Place list = place.at("channels");
    for (std::size_t i = 0; i < list.size(); ++i)
        read_channel(document, list[i], place.at("samplers"), weighted_by, channels, animation);

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
    const auto weighted_by = nodes_by_mesh(document);
    std::vector<Animation> animations;
    for (const Place& place : document.all("animations"))
        animations.push_back(read_animation(document, place, weighted_by));
    return animations;
}

}  // namespace gridreel::anim::gltf
