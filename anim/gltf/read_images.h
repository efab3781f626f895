#pragma once
// Images as they stand in the file.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <vector>

namespace gridreel::anim::gltf {

/// Every image's encoded bytes: from a buffer view, a data URI or a file. A file that is not there, or that
/// the model may not name because it lies outside its folder, is left out with a warning: the rest can be
/// shown.
///
/// @throws Error for a malformed data URI
[[nodiscard]] std::vector<Image> read_images(Document& document);

}  // namespace gridreel::anim::gltf
