#pragma once
// How images are looked up, and which image a texture takes.

#include "anim/gltf/document.h"
#include "anim/scene.h"

#include <span>
#include <vector>

namespace gridreel::anim::gltf {

/// Every texture with its sampler and its image: that of EXT_texture_webp before the core's. KTX2 images
/// (KHR_texture_basisu) are not read: the core's image stands in for them, which is warned of once. So are
/// drawn textures without any image.
///
/// @param materials  tell which textures are drawn
/// @throws Error for a texture of nothing but KTX2 that is drawn, or that is there although the file requires
///         the extension
[[nodiscard]] std::vector<Texture> read_textures(Document& document, std::span<const Material> materials);

}  // namespace gridreel::anim::gltf
