#pragma once
// A small generator of random numbers; the standard distributions differ between libraries.

#include <cstdint>

namespace gridreel::gallery {

/// SplitMix64 (Steele, Lea, Flood 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    [[nodiscard]] std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
        return z ^ (z >> 31);
    }

    /// Uniform in [low, high), multiples of 2^-53 of the range.
    [[nodiscard]] double between(double low, double high) {
        return low + (high - low) * (double(next() >> 11) * 0x1p-53);
    }

private:
    std::uint64_t state_;
};

}  // namespace gridreel::gallery
