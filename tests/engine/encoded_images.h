#pragma once
// Small image files made in memory.

#include "anim/scene.h"

#include <cstdint>
#include <vector>

namespace gridreel::test {

/// A PNG of `channels` interleaved 8-bit values a texel, row by row from the top left.
[[nodiscard]] anim::Image png(int width, int height, int channels, const std::vector<std::uint8_t>& values);

/// The same with 16 bits.
[[nodiscard]] anim::Image png16(int width, int height, int channels,
                                const std::vector<std::uint16_t>& values);

/// A JPEG of RGB values.
[[nodiscard]] anim::Image jpeg(int width, int height, const std::vector<std::uint8_t>& values);

}  // namespace gridreel::test
