#pragma once
// Which lights shine: the file's, or a default set.

#include "anim/clip.h"
#include "anim/pose.h"
#include "anim/scene.h"
#include "engine/lights.h"

#include <glm/vec3.hpp>

#include <vector>

namespace gridreel::engine {

/// The nodes of the clip's scene that carry a light, in node order.
[[nodiscard]] std::vector<anim::Index> light_nodes(const anim::Scene& scene, const anim::Clip& clip);

/// The lights at `nodes` in one pose.
[[nodiscard]] Lighting file_lighting(const anim::Scene& scene, const std::vector<anim::Index>& nodes,
                                     const anim::Pose& pose);

/// A dome, brighter above, and a far key light that casts shadows from the upper right front of the scene
/// (glTF scenes face +z). A white Lambert surface stays just below 1 wherever it faces.
///
/// @param box_min, box_max  of the whole clip, metres; the key light stands ten of its diagonals away
[[nodiscard]] Lighting default_lighting(const glm::vec3& box_min, const glm::vec3& box_max);

}  // namespace gridreel::engine
