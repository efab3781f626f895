#include "tools/gallery/walking_figure.h"

#include "tools/gallery/figure.h"
#include "tools/gallery/gait.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"

#include <array>
#include <string>
#include <vector>

namespace gridreel::gallery {

namespace {

constexpr int keys_per_cycle = 30;  ///< intervals

}  // namespace

void add_figure(Document& document, std::size_t triangles) {
    const SkinnedShape figure = make_figure(triangles);
    const Id material = append(document.materials, {.name = "clay", .roughness = 0.55, .glow = 0.012});
    const Id mesh = add_mesh(document, "figure", figure.shape, material);
    document.meshes[mesh].attributes.emplace_back("JOINTS_0", add_joints(document, figure.joints));
    document.meshes[mesh].attributes.emplace_back("WEIGHTS_0", add_weights(document, figure.weights));
    document.nodes.push_back({.name = "figure", .mesh = mesh, .skin = 0});
}

Id add_skeleton(Document& document) {
    const auto& rest = rest_joints();
    const Id first = static_cast<Id>(document.nodes.size());
    std::vector<glm::dvec3> to_joint;
    Skin skin;
    for (std::size_t joint = 0; joint < joint_count; ++joint) {
        const Id node = first + static_cast<Id>(joint);
        const glm::dvec3 parent = joint == hips ? glm::dvec3(0.0) : rest[rest[joint].parent].position;
        document.nodes.push_back(
            {.name = std::string(rest[joint].name), .translation = rest[joint].position - parent});
        if (joint != hips) document.nodes[first + rest[joint].parent].children.push_back(node);
        skin.joints.push_back(node);
        to_joint.push_back(-rest[joint].position);
    }
    skin.inverse_bind = add_translation_matrices(document, to_joint);
    document.skins.push_back(std::move(skin));
    return first;
}

void add_walk(Document& document, Id first_joint, Id companion, const Walk& way) {
    std::vector<float> times;
    std::vector<glm::dvec3> hips_positions;
    std::array<std::vector<glm::dquat>, joint_count> rotations;
    for (int key = 0; key <= way.cycles * keys_per_cycle; ++key) {
        const double phase = double(key) / keys_per_cycle;
        const WalkPose pose = walk(phase);
        times.push_back(static_cast<float>(phase * cycle_duration_s));
        hips_positions.push_back(pose.hips_position);
        for (std::size_t joint = 0; joint < joint_count; ++joint)
            rotations[joint].push_back(pose.local_rotation[joint]);
    }
    const Id input = add_times(document, times);
    animate_translation(document, first_joint, input, hips_positions);
    for (std::size_t joint = 0; joint < joint_count; ++joint)
        animate_rotation(document, first_joint + static_cast<Id>(joint), input, rotations[joint]);

    const std::array<float, 2> ends{0.0f, static_cast<float>(way.cycles * cycle_duration_s)};
    const std::array<glm::dvec3, 2> places{way.start,
                                           way.start + glm::dvec3(double(way.cycles) * stride_m, 0.0, 0.0)};
    animate_translation(document, companion, add_times(document, ends), places);
}

}  // namespace gridreel::gallery
