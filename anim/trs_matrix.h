#pragma once
// A translation, rotation and scale as one matrix.

#include "anim/scene.h"

#include <glm/mat4x4.hpp>

namespace gridreel::anim {

/// Translation * rotation * scale (glTF 2.0, section 3.5.3). The rotation need not be of unit length.
[[nodiscard]] glm::dmat4 matrix_of(const Trs& trs);

}  // namespace gridreel::anim
