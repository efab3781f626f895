#pragma once
// What the JSON says outright: nodes, scenes, skins, cameras, lights, materials, textures.

#include "anim/gltf/document.h"
#include "anim/scene.h"

namespace gridreel::anim::gltf {

/// A scene with everything but `meshes`, `animations` and `images`, from a validated document.
///
/// @throws Error for inverse bind matrices that are not finite
[[nodiscard]] Scene describe_scene(Document& document);

}  // namespace gridreel::anim::gltf
