#pragma once
// Where the camera stands and what lights a scene.

#include "tools/gallery/document.h"

#include <string>

namespace gridreel::gallery {

/// Adds a camera node at `eye`, looking at `target`, y up.
Id add_camera(Document& document, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_degrees,
              double far_m);

/// Adds a point light so bright that a white matt surface at `subject` facing it shows `radiance`
/// (E = I / d², L = E / pi).
Id add_light(Document& document, std::string name, const glm::dvec3& position, const glm::dvec3& subject,
             double radiance, const glm::dvec3& color);

}  // namespace gridreel::gallery
