#pragma once
// The rules of glTF 2.0 that a file must keep before anything is built from it. Each function throws an Error
// with the JSON pointer of the first defect it finds. `validate_shape` comes first; the others rely on it.

#include "anim/gltf/accessor.h"
#include "anim/gltf/place.h"

#include <span>

namespace gridreel::anim::gltf {

/// Types, required properties, ranges and every index (chapter 5).
void validate_shape(const Place& root);

/// Nodes form trees, scenes list their roots; skins and weights fit the meshes (sections 3.5, 3.7.2.2
/// and 3.7.3).
void validate_nodes(const Place& root, std::span<const Accessor> accessors);

/// Instances of a node have as many translations, rotations and scales, of the right types
/// (EXT_mesh_gpu_instancing).
void validate_instances(const Place& root, std::span<const Accessor> accessors);

/// Attributes, indices and morph targets have types and counts that fit together (section 3.7.2).
void validate_meshes(const Place& root, std::span<const Accessor> accessors);

/// Samplers and channels fit each other and their nodes; key values come later (section 3.11).
void validate_animations(const Place& root, std::span<const Accessor> accessors);

/// Cameras and lights describe something (section 3.10 and KHR_lights_punctual).
void validate_cameras_and_lights(const Place& root);

}  // namespace gridreel::anim::gltf
