#pragma once
// Textures on surfaces that do not say which part of them they show.

#include "anim/gltf/document.h"
#include "anim/scene.h"

namespace gridreel::anim::gltf {

/// Warns once of primitives whose material, in the file or in one of its variants, has a drawn texture on a
/// set of texture coordinates that they lack: at the first mesh that has one, with the number of primitives.
/// Zeros stand in for the coordinates, so that such a texture shows one colour everywhere.
void warn_of_missing_texcoords(Document& document, const Scene& scene);

}  // namespace gridreel::anim::gltf
