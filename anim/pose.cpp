#include "anim/pose.h"

#include "anim/animated_properties.h"
#include "anim/node_order.h"
#include "anim/sample_channel.h"
#include "anim/trs_matrix.h"
#include "anim/visibility.h"

#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace gridreel::anim {
namespace {

/// Morph weights where nothing animates them: the node's own, else its mesh's.
std::vector<float> resting_weights(const Scene& scene, const Node& node) {
    if (!node.mesh) return {};
    const std::vector<float>& of_mesh = scene.meshes[*node.mesh].weights;
    return node.weights.size() == of_mesh.size() ? node.weights : of_mesh;
}

/// The pose under construction: what channels write to, before parents are heeded.
struct Posed {
    Pose pose;
    std::vector<Trs> locals;
};

Posed at_rest(const Scene& scene, double time_s) {
    Posed posed;
    posed.pose.time_s = time_s;
    posed.pose.cameras = scene.cameras;
    posed.pose.lights = scene.lights;
    posed.pose.materials = scene.materials;
    posed.locals.reserve(scene.nodes.size());
    posed.pose.weights.reserve(scene.nodes.size());
    posed.pose.visible.reserve(scene.nodes.size());
    for (const Node& node : scene.nodes) {
        posed.locals.push_back(node.trs);
        posed.pose.weights.push_back(resting_weights(scene, node));
        posed.pose.visible.push_back(node.visible);
    }
    return posed;
}

template <class Object>
void set(const AnimatedProperty<Object>& property, const Sampler& sampler, double time_s, Object& object) {
    std::array<float, 4> value{};
    sample_numbers(sampler, time_s, std::span(value).first(property.width));
    property.set(object, value.data());
}

void apply(const Channel& channel, const Sampler& sampler, Posed& posed) {
    Pose& pose = posed.pose;
    const double time_s = pose.time_s;
    const Index object = channel.object;
    switch (channel.path) {
        case ChannelPath::translation:
            posed.locals[object].translation = sample_vec3(sampler, time_s);
            break;
        case ChannelPath::rotation:
            posed.locals[object].rotation = sample_rotation(sampler, time_s);
            break;
        case ChannelPath::scale:
            posed.locals[object].scale = sample_vec3(sampler, time_s);
            break;
        case ChannelPath::weights:
            sample_numbers(sampler, time_s, pose.weights[object]);
            break;
        case ChannelPath::weight:
            sample_numbers(sampler, time_s, std::span(pose.weights[object]).subspan(channel.property, 1));
            break;
        case ChannelPath::visibility:
            pose.visible[object] = sample_flag(sampler, time_s);
            break;
        case ChannelPath::camera:
            set(camera_properties()[channel.property], sampler, time_s, pose.cameras[object]);
            break;
        case ChannelPath::light:
            set(light_properties()[channel.property], sampler, time_s, pose.lights[object]);
            break;
        case ChannelPath::material:
            set(material_properties()[channel.property], sampler, time_s, pose.materials[object]);
            break;
    }
}

/// All channels of meshes, or all others. Where two animations meet, the later one stays.
void play(const Scene& scene, const Clip& clip, bool of_meshes, Posed& posed) {
    for (const Index index : clip.animations) {
        const Animation& animation = scene.animations[index];
        for (const Channel& channel : animation.channels) {
            if (channel.of_mesh == of_meshes) apply(channel, animation.samplers[channel.sampler], posed);
        }
    }
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
    Posed posed = at_rest(scene, time_s);

    // What a mesh gives to its nodes first: their own channels count more.
    play(scene, clip, true, posed);
    play(scene, clip, false, posed);

    posed.pose.world = world_matrices(scene, posed.locals);
    inherit_visibility(scene, posed.pose.visible);
    return std::move(posed.pose);
}

}  // namespace gridreel::anim
