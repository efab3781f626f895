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

bool drives_a_node(const Channel& channel) {
    return channel.path != ChannelPath::camera && channel.path != ChannelPath::light &&
           channel.path != ChannelPath::material;
}

/// The animations but for those that only move nodes of other scenes. Joints may stand in no scene at all.
std::vector<Index> of_scene(const Scene& scene, Index shown) {
    // Each tree once, however many scenes show it.
    std::set<Index> roots;
    for (const std::vector<Index>& other : scene.scenes) roots.insert(other.begin(), other.end());
    std::vector<bool> elsewhere(scene.nodes.size(), false);
    for (const Index node : depth_first(scene, std::vector<Index>(roots.begin(), roots.end())))
        elsewhere[node] = true;
    for (const Index node : depth_first(scene, scene.scenes[shown])) elsewhere[node] = false;

    std::vector<Index> found;
    for (Index i = 0; i < scene.animations.size(); ++i) {
        const std::vector<Channel>& channels = scene.animations[i].channels;
        const bool is_elsewhere =
            !channels.empty() && std::all_of(channels.begin(), channels.end(), [&](const Channel& channel) {
                return drives_a_node(channel) && elsewhere[channel.object];
            });
        if (!is_elsewhere) found.push_back(i);
    }
    return found;
}

/// No two animations drive the same property, so all can play together.
bool disjoint(const std::vector<Animation>& animations, const std::vector<Index>& chosen) {
    using Property = std::tuple<ChannelPath, Index, Index>;
    std::set<Property> taken;
    for (const Index index : chosen) {
        std::set<Property> driven;
        for (const Channel& channel : animations[index].channels) {
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

std::vector<Index> choose_animations(const Scene& scene, Index shown, std::string_view choice) {
    const std::vector<Animation>& animations = scene.animations;
    if (choice == "none") return {};
    if (choice == "all") return all_of(animations);
    if (choice == "auto") {
        const std::vector<Index> here = of_scene(scene, shown);
        if (here.empty() || disjoint(animations, here)) return here;
        return {here.front()};
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
    Clip clip{.scene = shown, .animations = choose_animations(scene, shown, animation)};
    clip.duration_s = duration_of(scene, clip.animations);
    return clip;
}

std::vector<Index> nodes_in_order(const Scene& scene, const Clip& clip) {
    return depth_first(scene, scene.scenes[clip.scene]);
}

}  // namespace gridreel::anim
