#pragma once
// Where in a pixel its samples lie.

#include <glm/vec2.hpp>

#include <cstdint>

namespace gridreel::engine {

/// Samples of every pixel: a fixed, well-spread set of points in the unit square.
///
/// Each pixel owns an Owen-scrambled Sobol' sequence in base 2 (Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4), 2020): with 2^k samples every dyadic rectangle of area 2^-k holds exactly one.
/// The same in every frame, so still parts of a sequence do not flicker.
struct SamplePattern {
    std::int32_t samples = 1;  ///< per pixel, >= 1
    std::uint32_t seed = 0;    ///< another seed, another scrambling of every pixel

    /// The place of sample `sample` in pixel (x, y), in [0, 1) x [0, 1) from the pixel's top left corner.
    /// A lone sample lies in the centre. Pure.
    [[nodiscard]] glm::vec2 place(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const;
};

}  // namespace gridreel::engine
