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
    static constexpr unsigned levels_per_step = 4;

    constexpr HilbertTable() {
        for (unsigned orientation = 0; orientation < orientations; ++orientation) {
            for (unsigned xy = 0; xy < entries; ++xy) at_[orientation][xy] = entry(orientation, xy);
        }
    }

    /// @param x  `levels_per_step` bits; y as well
    /// @param orientation  how the curve runs through this square; becomes how it runs through the cell's
    /// @return the cell's place along the curve
    constexpr std::uint32_t step(std::uint32_t x, std::uint32_t y, unsigned& orientation) const {
        const unsigned found = at_[orientation][x << levels_per_step | y];
        orientation = found >> 2 * levels_per_step;
        return found & (entries - 1);
    }

private:
    static constexpr unsigned orientations = 4;  // bit 0: x and y change places, bit 1: both run backwards
    static constexpr unsigned entries = 1u << 2 * levels_per_step;

    static constexpr std::uint16_t entry(unsigned orientation, unsigned xy) {
        const unsigned x = xy >> levels_per_step, y = xy & ((1u << levels_per_step) - 1);
        unsigned place = 0;
        for (unsigned level = levels_per_step; level-- > 0;) {
            unsigned right = x >> level & 1, upper = y >> level & 1;
            if ((orientation & 1) != 0) std::swap(right, upper);
            if ((orientation & 2) != 0) right ^= 1, upper ^= 1;
            place = place << 2 | (right << 1 | (right ^ upper));
            if (upper == 0) orientation ^= right != 0 ? 3 : 1;
        }
        return static_cast<std::uint16_t>(orientation << 2 * levels_per_step | place);
    }

    std::array<std::array<std::uint16_t, entries>, orientations> at_{};
};

inline constexpr HilbertTable hilbert_table;

/// The place along the curve of cell (x, y) of a square of 2^levels x 2^levels, both below 2^levels.
template <unsigned levels>
constexpr std::uint32_t hilbert_index(std::uint32_t x, std::uint32_t y) {
    static_assert(levels % HilbertTable::levels_per_step == 0 && levels <= 16);
    constexpr std::uint32_t mask = (1u << HilbertTable::levels_per_step) - 1;
    unsigned orientation = 0;
    std::uint32_t place = 0;
    for (unsigned level = levels; level > 0;) {
        level -= HilbertTable::levels_per_step;
        place = place << 2 * HilbertTable::levels_per_step |
                hilbert_table.step(x >> level & mask, y >> level & mask, orientation);
    }
    return place;
}

}  // namespace gridreel::traversal
