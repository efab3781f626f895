#pragma once
// Keys and what they move.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <vector>

namespace gridreel::anim::gltf {

/// Every animation of a validated document. Channels without a node are left out, as section 3.11 asks;
/// channels on a path that is not known are left out with a warning.
///
/// @throws Error for key times that are negative, not finite or not strictly increasing, and for key values
///         that are not finite or, as rotations, zero
[[nodiscard]] std::vector<Animation> read_animations(Document& document);

}  // namespace gridreel::anim::gltf
