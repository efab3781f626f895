#include "anim/gltf/read_animations.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace gridreel::anim::gltf {
namespace {

std::optional<ChannelPath> path_named(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, ChannelPath>, 4> paths{{
        {"translation", ChannelPath::translation},
        {"rotation", ChannelPath::rotation},
        {"scale", ChannelPath::scale},
        {"weights", ChannelPath::weights},
    }};
    const auto found =
        std::find_if(paths.begin(), paths.end(), [&](const auto& path) { return path.first == name; });
    if (found == paths.end()) return {};
    return found->second;
}

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

Sampler read_sampler(Document& document, const Place& place, ChannelPath path) {
    Sampler sampler;
    sampler.interpolation = interpolation_named(place.text_or("interpolation", "LINEAR"));
    sampler.times_s = read_times(document, place.at("input"));

    const Place output = place.at("output");
    sampler.values = document.floats(output.index(), output);
    for (const float value : sampler.values)
        if (!std::isfinite(value)) output.refuse(fmt::format("a key value is {}", value));
    const std::size_t per_key = sampler.interpolation == Interpolation::cubic_spline ? 3 : 1;
    sampler.width = static_cast<std::uint32_t>(sampler.values.size() / (sampler.times_s.size() * per_key));
    if (path == ChannelPath::rotation) check_rotations(sampler, output);
    return sampler;
}

Animation read_animation(Document& document, const Place& place) {
    Animation animation;
    animation.name = place.text_or("name", "");
    const Place samplers = place.at("samplers"), channels = place.at("channels");
    std::map<std::size_t, Index> kept;  // the file's sampler → ours
    std::set<std::string> unknown_paths;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const Place target = channels[i].at("target");
        const std::string& path_name = target.at("path").text();
        const auto path = path_named(path_name);
        if (!path) {
            unknown_paths.insert(path_name);
            continue;
        }
        const auto node = target.find_index("node");
        if (!node) continue;

        const std::size_t sampler = channels[i].at("sampler").integer();
        const auto [entry, is_new] = kept.emplace(sampler, static_cast<Index>(animation.samplers.size()));
        if (is_new) animation.samplers.push_back(read_sampler(document, samplers[sampler], *path));
        animation.channels.push_back({.node = *node, .path = *path, .sampler = entry->second});
    }
    if (!unknown_paths.empty())
        document.warn(place, fmt::format("channels on paths that are not supported are left out: {}",
                                         fmt::join(unknown_paths, ", ")));
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
