#pragma once
// Nodes: KHR_node_visibility and EXT_mesh_gpu_instancing.

#include "anim/gltf/document.h"

namespace gridreel::anim::gltf {

/// Completes `scene.nodes`, which must be those of the document, validated.
/// @throws Error for instances whose transforms are not finite or turn by a quaternion of length zero
void read_node_extensions(Document& document, Scene& scene);

}  // namespace gridreel::anim::gltf
