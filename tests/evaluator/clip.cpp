#include "clip.h"

#include <algorithm>
#include <numeric>

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

/// Whether they are one property, or a list and one of its elements.
bool overlap(const std::string& a, const std::string& b) {
    return a == b || a.starts_with(b + "/") || b.starts_with(a + "/");
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

    std::vector<std::string> animated;  // by the animations before
    for (const json& animation : animations) {
        std::vector<std::string> pointers;
        for (const json& channel : animation.at("channels")) {
            const std::string pointer = pointer_of(channel.at("target"));
            if (pointer.empty()) continue;
            pointers.push_back(pointer);
            const auto meets = [&](const std::string& other) { return overlap(pointer, other); };
            if (std::any_of(animated.begin(), animated.end(), meets)) return {0};
        }
        animated.insert(animated.end(), pointers.begin(), pointers.end());
    }
    return all;
}

}  // namespace gridreel::evaluator
