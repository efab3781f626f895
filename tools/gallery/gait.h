#pragma once
// One cycle of walking, two steps, as joint rotations.

#include "tools/gallery/figure.h"

#include <glm/gtc/quaternion.hpp>

#include <array>

namespace gridreel::gallery {

inline constexpr double stride_m = 1.2;  ///< forward (+x) per cycle
inline constexpr double cycle_duration_s = 1.25;

/// The figure at one phase of its cycle, in a frame that moves forward at constant speed.
struct WalkPose {
    glm::dvec3 hips_position;
    std::array<glm::dquat, joint_count> local_rotation;  ///< relative to the parent joint
};

/// @param phase  in cycles; 0 and 1 are the same pose: the right heel strikes
///
/// A standing foot stays where it is on the floor: it rolls over its heel, then over the ball of the
/// foot; hip and knee follow by inverse kinematics. The trunk sways and arms swing against the legs.
[[nodiscard]] WalkPose walk(double phase);

}  // namespace gridreel::gallery
