#pragma once
// A camera for scenes that have none.

#include "engine/camera.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace gridreel::engine {

/// Frames a box from the front, a little from the right and above (glTF scenes face +z), as near as its
/// eight corners allow with a margin of 5 % of the picture.
///
/// @param box_min, box_max  metres; a box without volume is fine, a point is seen from one metre
/// @param width, height     of the picture, pixels
[[nodiscard]] View fitting_view(const glm::dvec3& box_min, const glm::dvec3& box_max, std::int32_t width,
                                std::int32_t height);

}  // namespace gridreel::engine
