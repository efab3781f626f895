#pragma once
// Which camera the picture is taken with.

#include "anim/clip.h"
#include "anim/scene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace gridreel::engine {

/// Finds the node whose camera is meant.
///
/// @param choice  "auto": the first camera node of the clip's scene, depth first, if there is one; "fit":
///                none; else the name of a camera node, the name of a camera, or the number of a camera
///                node from 0, tried in this order
/// @return the node, or nothing: frame the clip with `fitting_view`
/// @throws Error listing the cameras there are, when nothing matches
[[nodiscard]] std::optional<anim::Index> choose_camera(const anim::Scene& scene, const anim::Clip& clip,
                                                       std::string_view choice);

/// Width over height that the camera of `node` asks for; 16:9 when it asks for none or there is no camera.
[[nodiscard]] double preferred_aspect(const anim::Scene& scene, std::optional<anim::Index> node);

}  // namespace gridreel::engine
