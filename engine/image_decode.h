#pragma once
// Pixels from an image file's bytes.

#include "anim/scene.h"

#include <glm/gtc/type_precision.hpp>

#include <cstdint>
#include <vector>

namespace gridreel::engine {

/// An image as stored: no transfer curve or colour profile applied, alpha not premultiplied.
struct DecodedImage {
    std::int32_t width = 0, height = 0;
    std::vector<glm::u16vec4> texels{};  ///< row by row from the top left; RGBA, 65535 is 1
};

/// Decodes PNG, JPEG or WebP, 8 or 16 bits a channel. Grey is spread over R, G, B; absent alpha is 1.
/// The format is told by the first bytes: files in the wild lie about their type.
/// @throws Error naming the image, when it is damaged, larger than 16384 x 16384, or of another format
[[nodiscard]] DecodedImage decode(const anim::Image& image);

}  // namespace gridreel::engine
