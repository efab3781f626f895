#pragma once
// What materials ask for and no picture shows yet.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <span>

namespace gridreel::anim::gltf {

/// Warns of looks that are not drawn: once for each kind, at the first material that has it, with the number
/// of materials that do. A look that is switched off, as a clearcoat of factor 0 is, does not count; nor does
/// any but the base colour on an unlit material. The shape must have been validated.
///
/// @param materials  as read from the document
void warn_of_undrawn_looks(Document& document, std::span<const Material> materials);

}  // namespace gridreel::anim::gltf
