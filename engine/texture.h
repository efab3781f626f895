#pragma once
// Looking up an image between its texels and across its sizes.

#include "anim/scene.h"
#include "engine/image_decode.h"

#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace gridreel::engine {

/// What an image's numbers mean.
enum class Encoding {
    srgb,    ///< R, G, B are sRGB-encoded colours, alpha is linear
    linear,  ///< plain numbers
};

/// An image in linear light at every size from its own down to 1 x 1, each half the one before (rounded
/// down), averaged over the area a texel covers.
///
/// Texels hold 16 bits of linear light a channel: the smallest step of 8-bit sRGB is 20 of these.
struct Pyramid {
    struct Level {
        std::int32_t width = 0, height = 0;
        std::vector<glm::u16vec4> texels{};  ///< row by row from the top left
    };
    std::vector<Level> levels;  ///< at least one

    Pyramid(DecodedImage image, Encoding encoding);
};

/// The image's value at `uv`: (0, 0) is the top left corner of the top left texel (glTF 2.0, section 3.8.2).
///
/// @param sampler    how to wrap and filter
/// @param uv         any value; not finite counts as 0
/// @param footprint  width of what is looked at as a share of the image's side, >= 0: chooses the size.
///                   0 always takes the finest.
/// @return linear RGBA in [0, 1]
[[nodiscard]] glm::vec4 sample(const Pyramid& image, const anim::Texture& sampler, const glm::vec2& uv,
                               float footprint);

}  // namespace gridreel::engine
