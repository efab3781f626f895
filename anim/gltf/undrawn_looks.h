#pragma once
// What materials ask for and no picture shows yet.

#include "anim/gltf/document.h"

namespace gridreel::anim::gltf {

/// Warns of normal and occlusion textures (glTF 2.0, section 3.9.3): once for each kind, at the first
/// material that has one, with the number of materials that do. Extensions are warned of as a whole
/// (`check_version_and_extensions`). The shape must have been validated.
void warn_of_undrawn_looks(Document& document);

}  // namespace gridreel::anim::gltf
