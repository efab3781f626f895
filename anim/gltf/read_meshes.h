#pragma once
// Triangles, attributes and morph targets.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <vector>

namespace gridreel::anim::gltf {

/// Every mesh of a validated document. Primitives without triangles or without positions are left out,
/// with a warning.
///
/// @throws Error for indices beyond the vertices, restart values, positions that are not finite
[[nodiscard]] std::vector<Mesh> read_meshes(Document& document);

/// Charges the budget for the morph weights of poses, in which every node has a list of its own: many nodes
/// may share a mesh of many targets, and neither takes more than a few bytes of the file.
///
/// @throws Error at the node where it is spent
void pay_for_morph_weights(Document& document, const Scene& scene);

}  // namespace gridreel::anim::gltf
