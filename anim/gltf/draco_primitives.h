#pragma once
// Primitives that are compressed by KHR_draco_mesh_compression.

#include "anim/gltf/document.h"

namespace gridreel::anim::gltf {

/// Decodes every compressed primitive and rewrites it to name accessors of the decoded values, so that the
/// document reads as though it had never been compressed: attributes of the extension, indices, and the mode,
/// which becomes a list of triangles. Other attributes and morph targets stay as they are.
///
/// Where the data cannot be decoded, but the accessors have uncompressed values too, those stay, with a
/// warning.
///
/// To be called when everything is validated: the decoded values have the types that the accessors state.
///
/// @throws Error for counts and types that do not match the data, modes without triangles, damaged data, and
///         when the budget does not allow it
void decompress_primitives(Document& document);

}  // namespace gridreel::anim::gltf
