#pragma once
// Rotations as unit quaternions.

#include <glm/gtc/quaternion.hpp>

namespace gridreel::anim {

/// `rotation` at unit length; the identity when it is zero and so no rotation at all.
[[nodiscard]] glm::dquat unit_or_identity(const glm::dquat& rotation);

/// From `from` at 0 to `to` at 1 with constant speed, the shorter way round (glTF 2.0, appendix C.4),
/// normalised afterwards. Exactly `from`, normalised, when both are equal.
///
/// @param from, to  about unit length. Keys that a file rounds to a few digits are taken as they stand, as
///                  the formula does: making them unit first moves what lies between by some 1e-5.
/// @param u         in [0, 1]
[[nodiscard]] glm::dquat slerp_shortest(const glm::dquat& from, const glm::dquat& to, double u);

}  // namespace gridreel::anim
