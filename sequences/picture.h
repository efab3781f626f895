#pragma once
// A frame's pixels exactly as its file will hold them.

#include "engine/film.h"
#include "sequences/image_settings.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gridreel::sequences {

enum class PixelType { byte, half_float, single_float };

struct PictureChannel {
    std::string name;  ///< R G B A, Z, N.X N.Y N.Z
    PixelType type = PixelType::byte;
};

/// Interleaved pixels, row by row from the top left, channels in the order of `channels`, each value
/// in its type's size and the machine's byte order.
struct Picture {
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<PictureChannel> channels;
    std::vector<std::byte> pixels;
};

/// Rounds a film to what is stored; `picture` keeps its memory.
///
/// EXR: linear, premultiplied; values beyond half precision's range become its largest (65504).
/// PNG: sRGB curve (IEC 61966-2-1), straight alpha, 8 bits, rounded to nearest; not-a-number becomes 0.
/// @param settings  checked
void store(const engine::Film& film, const ImageSettings& settings, Picture& picture);

/// 8-bit sRGB of a linear value, clamped to [0, 1].
[[nodiscard]] std::uint8_t srgb_byte(float linear);

}  // namespace gridreel::sequences
