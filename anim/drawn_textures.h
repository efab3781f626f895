#pragma once
// Which of a material's textures pictures show.

#include "anim/material.h"

#include <vector>

namespace gridreel::anim {

/// What a texture's numbers mean.
enum class TextureMeaning {
    color,    ///< R, G, B are sRGB-encoded, alpha is linear
    numbers,  ///< plain
};

struct DrawnTexture {
    TextureRef ref;
    TextureMeaning meaning = TextureMeaning::color;
};

/// Those that shading looks up; the others are read, and not drawn yet.
[[nodiscard]] std::vector<DrawnTexture> drawn_textures(const Material& material);

}  // namespace gridreel::anim
