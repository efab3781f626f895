#include "anim/visibility.h"

#include "anim/node_order.h"
#include "anim/sample_channel.h"

#include <algorithm>
#include <optional>

namespace gridreel::anim {
namespace {

/// What the node's own flag is at any time of a channel that drives it.
Shown shown_by(const Sampler& sampler) {
    const auto set = [&](float time_s) { return sample_flag(sampler, double(time_s)); };
    const auto& times = sampler.times_s;
    if (std::all_of(times.begin(), times.end(), set)) return Shown::always;
    return std::any_of(times.begin(), times.end(), set) ? Shown::sometimes : Shown::never;
}

}  // namespace

std::vector<Shown> shown_in(const Scene& scene, const Clip& clip) {
    // Each node for itself. Where two animations meet, the later one stays, as in `pose`.
    std::vector<Shown> shown;
    shown.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) shown.push_back(node.visible ? Shown::always : Shown::never);
    for (const Index index : clip.animations) {
        const Animation& animation = scene.animations[index];
        // Once, however many channels share it.
        std::vector<std::optional<Shown>> by_sampler(animation.samplers.size());
        for (const Channel& channel : animation.channels) {
            if (channel.path != ChannelPath::visibility) continue;
            auto& known = by_sampler[channel.sampler];
            if (!known) known = shown_by(animation.samplers[channel.sampler]);
            shown[channel.object] = *known;
        }
    }

    // No more than its parent.
    for (const Index node : all_parents_first(scene)) {
        const auto& parent = scene.nodes[node].parent;
        if (parent) shown[node] = std::min(shown[node], shown[*parent]);
    }
    return shown;
}

void inherit_visibility(const Scene& scene, std::vector<bool>& visible) {
    for (const Index node : all_parents_first(scene)) {
        const auto& parent = scene.nodes[node].parent;
        if (parent && !visible[*parent]) visible[node] = false;
    }
}

}  // namespace gridreel::anim
