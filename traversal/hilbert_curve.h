#pragma once
// Hilbert's curve through a square of cells: any run of neighbours on it is compact.
// David Hilbert, "Ueber die stetige Abbildung einer Linie auf ein Flaechenstueck", 1891.

#include <array>
#include <cstdint>
#include <utility>

namespace gridreel::traversal {

/// A square is four quarters, from the largest square down: (0, 0), (0, 1), (1, 1), (1, 0). The curve runs
/// through the first and the last mirrored on a diagonal, so that it goes on where it left the one before.
class HilbertTable {
public:
    static constexpr unsigned levels = 4;  ///< looked up at once

    constexpr HilbertTable() {
        for (unsigned turn = 0; turn < turns; ++turn) {
            for (unsigned xy = 0; xy < entries; ++xy) at_[turn][xy] = entry(turn, xy);
        }
    }

    /// @param x  `levels` bits; y as well
    /// @param turn  how the curve runs through this square; becomes how it runs through the cell's
    /// @return the cell's place along the curve
    constexpr std::uint32_t step(std::uint32_t x, std::uint32_t y, unsigned& turn) const {
        const unsigned found = at_[turn][x << levels | y];
        turn = found >> 2 * levels;
        return found & (entries - 1);
    }

private:
    static constexpr unsigned turns = 4;  // bit 0: x and y change places, bit 1: both run backwards
    static constexpr unsigned entries = 1u << 2 * levels;

    static constexpr std::uint16_t entry(unsigned turn, unsigned xy) {
        const unsigned x = xy >> levels, y = xy & ((1u << levels) - 1);
        unsigned place = 0;
        for (unsigned level = levels; level-- > 0;) {
            unsigned right = x >> level & 1, upper = y >> level & 1;
            if ((turn & 1) != 0) std::swap(right, upper);
            if ((turn & 2) != 0) right ^= 1, upper ^= 1;
            place = place << 2 | (right << 1 | (right ^ upper));
            if (upper == 0) turn ^= right != 0 ? 3 : 1;
        }
        return static_cast<std::uint16_t>(turn << 2 * levels | place);
    }

    std::array<std::array<std::uint16_t, entries>, turns> at_{};
};

inline constexpr HilbertTable hilbert_table;

/// The place along the curve of cell (x, y) of a square of 2^levels x 2^levels, both below 2^levels.
template <unsigned levels>
constexpr std::uint32_t hilbert_place(std::uint32_t x, std::uint32_t y) {
    static_assert(levels % HilbertTable::levels == 0 && levels <= 16);
    constexpr std::uint32_t mask = (1u << HilbertTable::levels) - 1;
    unsigned turn = 0;
    std::uint32_t place = 0;
    for (unsigned level = levels; level > 0;) {
        level -= HilbertTable::levels;
        place = place << 2 * HilbertTable::levels |
                hilbert_table.step(x >> level & mask, y >> level & mask, turn);
    }
    return place;
}

}  // namespace gridreel::traversal
