#include "anim/clip.h"

#include "anim/error.h"
#include "anim/node_order.h"
#include "anim/parse_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <tuple>

namespace gridreel::anim {
namespace {

std::string names_of(const std::vector<Animation>& animations) {
    if (animations.empty()) return "the file has no animations: leave the option out";
    std::string names = "choose auto, all, none or one of";
    for (std::size_t i = 0; i < animations.size(); ++i) {
        names += fmt::format("{} {} \"{}\"", i == 0 ? "" : ",", i, animations[i].name);
    }
    return names;
}

/// No two animations drive the same property, so all can play together.
bool disjoint(const std::vector<Animation>& animations) {
    using Property = std::tuple<ChannelPath, Index, Index>;
    std::set<Property> taken;
    for (const Animation& animation : animations) {
        std::set<Property> driven;
        for (const Channel& channel : animation.channels) {
            // One weight of a node takes them all.
            const bool is_weight = channel.path == ChannelPath::weight;
            driven.emplace(is_weight ? ChannelPath::weights : channel.path, channel.object,
                           is_weight ? 0 : channel.property);
        }
        for (const auto& property : driven) {
            if (!taken.insert(property).second) return false;
        }
    }
    return true;
}

std::vector<Index> all_of(const std::vector<Animation>& animations) {
    std::vector<Index> all(animations.size());
    std::iota(all.begin(), all.end(), Index{0});
    return all;
}

std::vector<Index> choose_animations(const std::vector<Animation>& animations, std::string_view choice) {
    if (choice == "none") return {};
    if (choice == "all") return all_of(animations);
    if (choice == "auto") {
        if (animations.empty()) return {};
        return disjoint(animations) ? all_of(animations) : std::vector<Index>{0};
    }

    // A name wins over a number: an animation may well be called "1".
    const auto named = std::find_if(animations.begin(), animations.end(),
                                    [&](const Animation& animation) { return animation.name == choice; });
    if (named != animations.end()) return {static_cast<Index>(named - animations.begin())};
    if (const auto number = parse_number<std::size_t>(choice); number && *number < animations.size()) {
        return {static_cast<Index>(*number)};
    }
    throw Error(fmt::format("no animation \"{}\"", choice), "--animation", names_of(animations));
}

/// The last key of any property that is animated.
double duration_of(const Scene& scene, const std::vector<Index>& animations) {
    double last_s = 0.0;
    for (const Index animation : animations) {
        const Animation& playing = scene.animations[animation];
        for (const Channel& channel : playing.channels) {
            last_s = std::max(last_s, double(playing.samplers[channel.sampler].times_s.back()));
        }
    }
    return last_s;
}

}  // namespace

Clip choose_clip(const Scene& scene, std::string_view animation, std::optional<Index> scene_index) {
    const Index shown = scene_index.value_or(scene.default_scene);
    if (shown >= scene.scenes.size()) {
        throw Error(fmt::format("no scene {}", shown), "--scene",
                    fmt::format("choose a number from 0 to {}", scene.scenes.size() - 1));
    }
    Clip clip{.scene = shown, .animations = choose_animations(scene.animations, animation)};
    clip.duration_s = duration_of(scene, clip.animations);
    return clip;
}

std::vector<Index> nodes_in_order(const Scene& scene, const Clip& clip) {
    return depth_first(scene, scene.scenes[clip.scene]);
}

}  // namespace gridreel::anim
