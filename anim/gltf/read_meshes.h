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

}  // namespace gridreel::anim::gltf
