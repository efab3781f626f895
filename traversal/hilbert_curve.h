#pragma once
// Hilbert's curve through a square of cells: any run of neighbours on it is compact.
// David Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.

#include <cstdint>

namespace gridreel::traversal {

/// Of the lower 16 bits, bit i goes to bit 2 i.
constexpr std::uint32_t spread_bits(std::uint32_t bits) {
    bits = (bits | bits << 8) & 0x00ff00ffu;
    bits = (bits | bits << 4) & 0x0f0f0f0fu;
    bits = (bits | bits << 2) & 0x33333333u;
    return (bits | bits << 1) & 0x55555555u;
}

/// The place along the curve of cell (x, y) of a square of 2^levels x 2^levels, both below 2^levels.
///
/// A square is four quarters, from the largest square down: (0, 0), (0, 1), (1, 1), (1, 0). The curve runs
/// through the first and the last mirrored on a diagonal, so that it goes on where it left the one before.
///
/// How it runs through a square is two bits: whether x and y change places, and whether both run backwards.
/// A level turns those of the square (s, c) into those of its quarter by an affine map over bits,
///     s' = !d s + c + !y,   c' = d s + !d c + x !y,   d = x + y,
/// so maps of levels compose like those of any such maps, and all levels at once by doubling (Hillis & Steele
/// 1986), a bit a level. Without a table or a branch, compilers work on many cells side by side.
template <unsigned levels>
constexpr std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y) {
    static_assert(levels >= 1 && levels <= 16);
    constexpr std::uint32_t all = (1u << levels) - 1;
    const std::uint32_t d = x ^ y;
    // What becomes s and c of each level: how much of each there was before, and what is added.
    std::uint32_t s_of_s = all ^ d, s_of_c = all, c_of_s = d, c_of_c = all ^ d;
    std::uint32_t s = all ^ y, c = x & s;
    for (unsigned step = 1; step < levels; step *= 2) {
        const std::uint32_t upper_s = s >> step, upper_c = c >> step;
        s ^= (s_of_s & upper_s) ^ (s_of_c & upper_c);
        c ^= (c_of_s & upper_s) ^ (c_of_c & upper_c);
        const std::uint32_t upper_ss = s_of_s >> step, upper_sc = s_of_c >> step;
        const std::uint32_t upper_cs = c_of_s >> step, upper_cc = c_of_c >> step;
        const std::uint32_t ss = s_of_s, cs = c_of_s;
        s_of_s = (ss & upper_ss) ^ (s_of_c & upper_cs);
        s_of_c = (ss & upper_sc) ^ (s_of_c & upper_cc);
        c_of_s = (cs & upper_ss) ^ (c_of_c & upper_cs);
        c_of_c = (cs & upper_sc) ^ (c_of_c & upper_cc);
    }
    // Each level's quarter, by how the curve runs through the square around it.
    return spread_bits(x ^ (d & s >> 1) ^ c >> 1) << 1 | spread_bits(d);
}

}  // namespace gridreel::traversal
