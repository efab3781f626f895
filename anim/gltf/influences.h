#pragma once
// Which joints move a vertex, and how much.

#include "anim/gltf/document.h"
#include "anim/scene.h"

namespace gridreel::anim::gltf {

/// All JOINTS_n/WEIGHTS_n pairs of a primitive side by side, weights divided by their sum (section 3.7.3.3).
/// A joint without weight reads as 0; a vertex without any weight follows joint 0.
///
/// @throws Error for weights that are negative or not finite
[[nodiscard]] Influences read_influences(Document& document, const Place& attributes);

/// @throws Error when a vertex of a skinned node follows a joint that the node's skin does not have
void check_joints_exist(const Document& document, const Scene& scene);

}  // namespace gridreel::anim::gltf
