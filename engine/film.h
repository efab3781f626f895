#pragma once
// The frame buffer.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gridreel::engine {

/// One frame: interleaved float channels, row by row from the top left.
/// R G B are linear (Rec. 709 primaries) and premultiplied by A. Z is the distance along the camera's
/// view axis in metres, infinity where nothing was hit. N is the unit world-space shading normal, zero
/// where nothing was hit. R G B A are averages over a pixel's samples; Z and N are of its nearest sample.
struct Film {
    static constexpr std::size_t channel_count = 8;
    enum Channel : std::size_t { R, G, B, A, Z, NX, NY, NZ };

    std::int32_t width = 0;
    std::int32_t height = 0;
    std::vector<float> pixels;  ///< height * width * channel_count

    void resize(std::int32_t new_width, std::int32_t new_height);
    [[nodiscard]] float* pixel(std::int32_t x, std::int32_t y);
    [[nodiscard]] const float* pixel(std::int32_t x, std::int32_t y) const;
};

}  // namespace gridreel::engine
