#include "engine/pixel_order.h"

#include <array>
#include <cassert>
#include <cstddef>

namespace gridreel::engine {
namespace {

constexpr std::size_t tile_pixels = std::size_t(tile_size) * std::size_t(tile_size);

/// Every second bit of an 8-bit Morton code, from bit 0.
constexpr std::uint16_t even_bits(std::size_t code) {
    return static_cast<std::uint16_t>((code & 1) | ((code >> 1) & 2) | ((code >> 2) & 4) | ((code >> 3) & 8));
}

/// The pixels of one tile along the Z curve.
constexpr std::array<Pixel, tile_pixels> morton_walk() {
    static_assert(tile_size == 16, "even_bits takes four bits an axis");
    std::array<Pixel, tile_pixels> walk{};
    for (std::size_t code = 0; code < walk.size(); ++code) {
        walk[code] = {.x = even_bits(code), .y = even_bits(code >> 1)};
    }
    return walk;
}

}  // namespace

std::vector<Pixel> pixel_order(std::int32_t width, std::int32_t height) {
    assert(width >= 1 && width <= largest_picture && height >= 1 && height <= largest_picture);
    static constexpr auto walk = morton_walk();

    std::vector<Pixel> order;
    order.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::int32_t top = 0; top < height; top += tile_size) {
        for (std::int32_t left = 0; left < width; left += tile_size) {
            for (const Pixel step : walk) {
                const std::int32_t x = left + step.x;
                const std::int32_t y = top + step.y;
                if (x >= width || y >= height) continue;
                order.push_back({.x = static_cast<std::uint16_t>(x), .y = static_cast<std::uint16_t>(y)});
            }
        }
    }
    return order;
}

}  // namespace gridreel::engine
