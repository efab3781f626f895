#pragma once
// What surfaces look like.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <vector>

namespace gridreel::anim::gltf {

/// Every material with the extensions that are known (glTF 2.0, section 3.9, KHR_materials_*,
/// KHR_texture_transform); what the file leaves out is as their specifications say. The shape must have been
/// validated. A texture on a set of texture coordinates beyond 1 is left out with a warning.
[[nodiscard]] std::vector<Material> read_materials(Document& document);

}  // namespace gridreel::anim::gltf
