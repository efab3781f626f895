#pragma once
// Which versions of glTF are understood.

#include "anim/gltf/place.h"

namespace gridreel::anim::gltf {

/// Refuses anything but glTF 2.x that a reader of 2.0 may read (glTF 2.0, section 3.2). Needs nothing
/// validated but that the text is JSON.
///
/// @throws Error naming the version
void check_version(const Place& root);

}  // namespace gridreel::anim::gltf
