#pragma once
// What materials ask for and no picture shows yet.

#include "anim/gltf/document.h"
#include "anim/scene.h"

namespace gridreel::anim::gltf {

/// Warns of looks that are not drawn: once for each kind, at the first material that has it, with the number
/// of materials that do. A look that is switched off, as a clearcoat of factor 0 is, does not count unless an
/// animation drives that factor; nor does any but the base colour on an unlit material. The shape must have
/// been validated.
///
/// @param scene  with its materials and animations
void warn_of_undrawn_looks(Document& document, const Scene& scene);

}  // namespace gridreel::anim::gltf
