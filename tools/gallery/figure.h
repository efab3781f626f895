#pragma once
// A jointed figure: its skeleton, its solid body and its skin.

#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/surface_nets.h"

#include <glm/gtc/type_precision.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace gridreel::gallery {

/// The figure stands at the origin, faces +x, right hand towards +z. `left` follows `right` by `side_step`.
enum Joint : std::size_t {
    hips,
    spine,
    chest,
    neck,
    head,
    upper_arm_right,
    forearm_right,
    hand_right,
    thigh_right,
    shin_right,
    foot_right,
    toes_right,
    upper_arm_left,
    forearm_left,
    hand_left,
    thigh_left,
    shin_left,
    foot_left,
    toes_left,
    joint_count
};
inline constexpr std::size_t side_step = upper_arm_left - upper_arm_right;

/// At rest all joints' frames are those of the world.
struct JointRest {
    std::string_view name;
    Joint parent;  ///< `hips` of itself
    glm::dvec3 position;
};
[[nodiscard]] const std::array<JointRest, joint_count>& rest_joints();

/// The skin at rest, with up to four joints a vertex.
struct SkinnedShape {
    Shape shape{};
    std::vector<glm::u8vec4> joints{};
    std::vector<glm::u16vec4> weights{};  ///< each vertex sums to 65535
};

/// Polygonises the body to about `triangles` triangles and binds it: a joint's weight falls off with the
/// distance from its own part of the body.
[[nodiscard]] SkinnedShape make_figure(std::size_t triangles);

}  // namespace gridreel::gallery
