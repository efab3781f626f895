#pragma once
// The order in which a picture's pixels are traced.

#include <cstdint>
#include <vector>

namespace gridreel::engine {

struct Pixel {
    std::uint16_t x = 0, y = 0;  ///< from the top left

    friend bool operator==(const Pixel&, const Pixel&) = default;
};

inline constexpr std::int32_t tile_size = 16;           ///< pixels a side
inline constexpr std::int32_t largest_picture = 65535;  ///< pixels a side, what `Pixel` can hold

/// Every pixel once: tiles of 16 x 16 row by row, a Morton walk within each. So 4^k consecutive pixels
/// that start at a multiple of 4^k (k <= 4) of an uncut tile form a square, which makes compact packets.
///
/// @param width, height  in [1, largest_picture]
[[nodiscard]] std::vector<Pixel> pixel_order(std::int32_t width, std::int32_t height);

}  // namespace gridreel::engine
