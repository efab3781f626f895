#pragma once
// Images as they stand in the file.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <vector>

namespace gridreel::anim::gltf {

/// Every image's encoded bytes: from a buffer view, a data URI or a file. One that is not there is a warning.
///
/// @throws Error for URIs that lead out of the file's folder or are malformed
[[nodiscard]] std::vector<Image> read_images(Document& document);

}  // namespace gridreel::anim::gltf
