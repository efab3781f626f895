#include "anim/motion.h"

#include "anim/node_order.h"
#include "anim/sample_channel.h"

#include <algorithm>

namespace gridreel::anim {

Motion find_motion(const Scene& scene, const Clip& clip) {
    Motion motion{.world = std::vector<bool>(scene.nodes.size(), false),
                  .weights = std::vector<bool>(scene.nodes.size(), false)};

    // Nodes that a channel moves. Exporters key every bone, moving or not: constant keys do not count.
    for (const Index index : clip.animations) {
        const Animation& animation = scene.animations[index];
        std::vector<bool> varying(animation.samplers.size());
        std::transform(animation.samplers.begin(), animation.samplers.end(), varying.begin(), varies);
        for (const Channel& channel : animation.channels) {
            if (!varying[channel.sampler]) continue;
            switch (channel.path) {
                case ChannelPath::translation:
                case ChannelPath::rotation:
                case ChannelPath::scale:
                    motion.world[channel.object] = true;
                    break;
                case ChannelPath::weights:
                case ChannelPath::weight:
                    motion.weights[channel.object] = true;
                    break;
                default:  // hides or colours, but moves nothing
                    break;
            }
        }
    }

    // Children go with their parents.
    for (const Index node : all_parents_first(scene)) {
        const auto& parent = scene.nodes[node].parent;
        if (parent && motion.world[*parent]) motion.world[node] = true;
    }
    return motion;
}

bool moves(const Scene& scene, const Motion& motion, Index node, const Primitive& primitive) {
    const Node& bearer = scene.nodes[node];
    if (!primitive.targets.empty() && motion.weights[node]) return true;
    if (!is_skinned(bearer, primitive)) return motion.world[node];
    const std::vector<Index>& joints = scene.skins[*bearer.skin].joints;
    return std::any_of(joints.begin(), joints.end(), [&](Index joint) { return motion.world[joint]; });
}

bool is_skinned(const Node& node, const Primitive& primitive) {
    return node.skin && primitive.influences.per_vertex > 0;
}

}  // namespace gridreel::anim
