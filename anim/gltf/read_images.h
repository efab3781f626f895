#pragma once
// Images as they stand in the file.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <span>
#include <vector>

namespace gridreel::anim::gltf {

/// Every image's encoded bytes: from a buffer view, a data URI or a file. A file that is not there, or that
/// the model may not name because it lies outside its folder, is left out with a warning: the rest can be
/// shown.
///
/// @param textures  of the document: images that only KHR_texture_basisu names are not fetched
/// @throws Error for a malformed data URI
[[nodiscard]] std::vector<Image> read_images(Document& document, std::span<const Texture> textures);

}  // namespace gridreel::anim::gltf
