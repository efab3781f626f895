#include "anim/pose.h"

#include "anim/node_order.h"
#include "anim/rotation.h"
#include "anim/sample_channel.h"

#include <cstddef>

namespace gridreel::anim {
namespace {

/// Morph weights where nothing animates them: the node's own, else its mesh's.
std::vector<float> resting_weights(const Scene& scene, const Node& node) {
    if (!node.mesh) return {};
    const std::vector<float>& of_mesh = scene.meshes[*node.mesh].weights;
    return node.weights.size() == of_mesh.size() ? node.weights : of_mesh;
}

void apply(const Animation& animation, double time_s, std::vector<Trs>& locals,
           std::vector<std::vector<float>>& weights) {
    for (const Channel& channel : animation.channels) {
        const Sampler& sampler = animation.samplers[channel.sampler];
        Trs& local = locals[channel.node];
        switch (channel.path) {
            case ChannelPath::translation:
                local.translation = sample_vec3(sampler, time_s);
                break;
            case ChannelPath::rotation:
                local.rotation = sample_rotation(sampler, time_s);
                break;
            case ChannelPath::scale:
                local.scale = sample_vec3(sampler, time_s);
                break;
            case ChannelPath::weights:
                sample_weights(sampler, time_s, weights[channel.node]);
                break;
        }
    }
}

/// Translation * rotation * scale.
glm::dmat4 matrix_of(const Trs& trs) {
    const glm::dmat3 rotation = glm::mat3_cast(unit_or_identity(trs.rotation));
    return {glm::dvec4{rotation[0] * trs.scale.x, 0.0}, glm::dvec4{rotation[1] * trs.scale.y, 0.0},
            glm::dvec4{rotation[2] * trs.scale.z, 0.0}, glm::dvec4{trs.translation, 1.0}};
}

/// World matrices of all nodes of the file: a skin's joints may stand outside the scene that is shown.
std::vector<glm::dmat4> world_matrices(const Scene& scene, const std::vector<Trs>& locals) {
    std::vector<glm::dmat4> world(scene.nodes.size(), glm::dmat4{1.0});
    for (const Index index : all_parents_first(scene)) {
        const Node& node = scene.nodes[index];
        const glm::dmat4 local = node.matrix ? *node.matrix : matrix_of(locals[index]);
        world[index] = node.parent ? world[*node.parent] * local : local;
    }
    return world;
}

}  // namespace

Pose pose(const Scene& scene, const Clip& clip, double time_s) {
    // At rest.
    std::vector<Trs> locals;
    std::vector<std::vector<float>> weights;
    locals.reserve(scene.nodes.size());
    weights.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        locals.push_back(node.trs);
        weights.push_back(resting_weights(scene, node));
    }

    // Animated; where two animations meet, the later one stays.
    for (const Index animation : clip.animations) {
        apply(scene.animations[animation], time_s, locals, weights);
    }

    return {.time_s = time_s,
            .world = world_matrices(scene, locals),
            .weights = std::move(weights),
            .cameras = scene.cameras,
            .lights = scene.lights,
            .materials = scene.materials};
}

}  // namespace gridreel::anim
