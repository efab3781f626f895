#include "engine/sample_pattern.h"

namespace gridreel::engine {
namespace {

std::uint32_t reverse_bits(std::uint32_t v) {
    v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
    return (v >> 16) | (v << 16);
}

/// PCG's output permutation as a hash (Jarzynski & Olano, JCGT 9(3), 2020).
std::uint32_t hash(std::uint32_t v) {
    const std::uint32_t state = v * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

/// Owen's nested permutation of the bits of `v`, from the high bit down: every bit is flipped or not by a
/// hash of the bits above it. The multiplications carry only upwards, hence the reversal (Burley, listing 3,
/// with the constants of Vegdahl's refinement).
std::uint32_t scramble(std::uint32_t v, std::uint32_t seed) {
    v = reverse_bits(v);
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return reverse_bits(v);
}

/// Second dimension of Sobol's sequence: direction numbers v_1 = 1/2, v_{k+1} = v_k xor v_k / 2.
std::uint32_t sobol_second(std::uint32_t index) {
    std::uint32_t point = 0;
    for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1) {
        if (index & 1u) point ^= direction;
    }
    return point;
}

/// The top 24 bits as a fraction: a float holds them exactly and stays below 1.
float unit_fraction(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

}  // namespace

glm::vec2 SamplePattern::place(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    if (samples == 1) return {0.5f, 0.5f};
    const std::uint32_t pixel_seed = hash(x + hash(y + hash(seed)));
    return {unit_fraction(scramble(reverse_bits(sample), pixel_seed)),
            unit_fraction(scramble(sobol_second(sample), hash(pixel_seed)))};
}

}  // namespace gridreel::engine
