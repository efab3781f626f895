#include "clip.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace gridreel::evaluator {
namespace {

using nlohmann::json;

/// Empty for a channel that is to be ignored: one without a node (section 3.11).
std::string pointer_of(const json& target) {
    const std::string path = target.at("path");
    if (path == "pointer") return target.at("extensions").at("KHR_animation_pointer").at("pointer");
    if (!target.contains("node")) return "";
    return "/nodes/" + std::to_string(target["node"].get<std::size_t>()) + "/" + path;
}

Keyframes read_keys(const File& file, const json& sampler, const std::string& pointer) {
    Keyframes keys;
    keys.times_s = read_accessor(file, sampler.at("input")).values;
    keys.values = read_accessor(file, sampler.at("output")).values;
    const std::string interpolation = sampler.value("interpolation", "LINEAR");
    if (interpolation == "STEP") keys.interpolation = Interpolation::step;
    if (interpolation == "CUBICSPLINE") keys.interpolation = Interpolation::cubic_spline;
    const std::size_t elements_per_key = interpolation == "CUBICSPLINE" ? 3 : 1;
    keys.width = keys.values.size() / (elements_per_key * keys.times_s.size());
    keys.is_rotation = pointer.starts_with("/nodes/") && pointer.ends_with("/rotation");
    return keys;
}

/// The property that counts where animations meet: all weights of a node are one.
std::string property_of(const std::string& pointer) {
    const auto weight = pointer.find("/weights/");
    return weight == pointer.npos ? pointer : pointer.substr(0, weight) + "/weights";
}

}  // namespace

Clip play(const File& file, const std::vector<std::size_t>& animations) {
    Clip clip;
    for (const std::size_t animation : animations) {
        const json& entry = file.json.at("animations").at(animation);
        for (const json& channel : entry.at("channels")) {
            const std::string pointer = pointer_of(channel.at("target"));
            if (pointer.empty()) continue;
            const json& sampler = entry.at("samplers").at(channel.at("sampler").get<std::size_t>());
            clip.channels.push_back({pointer, read_keys(file, sampler, pointer)});
            clip.end_s = std::max(clip.end_s, clip.channels.back().keys.times_s.back());
        }
    }
    return clip;
}

std::vector<std::size_t> animations_by_default(const File& file) {
    const json animations = file.json.value("animations", json::array());
    std::vector<std::size_t> all(animations.size());
    std::iota(all.begin(), all.end(), std::size_t{0});

    std::set<std::string> animated;  // by the animations before
    for (const json& animation : animations) {
        std::set<std::string> properties;
        for (const json& channel : animation.at("channels")) {
            const std::string pointer = pointer_of(channel.at("target"));
            if (!pointer.empty()) properties.insert(property_of(pointer));
        }
        for (const std::string& property : properties)
            if (!animated.insert(property).second) return {0};
    }
    return all;
}

}  // namespace gridreel::evaluator
