#pragma once
// How far each cell of a grid is from the nearest one that holds anything.

#include "rebuild/buffer.h"
#include "rebuild/grid.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// A grid's cells at every level of nesting, level after level, in a byte each: 0 for those that hold
/// anything, else how many steps, aslant ones included, the nearest of those in the same grid is away, at
/// most `farthest`. So the cube of cells fewer steps away is empty, and a ray leaves it in one stride (Cohen
/// & Sheffer, "Proximity clouds", 1994).
class CellDistances {
public:
    static constexpr int farthest = 8;

    /// Parallel.
    /// @param most  1 to `farthest`: empty cells farther away count as `most` steps away; 1 is made in one
    /// pass
    void rebuild(const rebuild::Grid& grid, int most = farthest);

    /// The first level's cells, then the next level's, each in its order. 7 bytes behind the last may be
    /// read.
    [[nodiscard]] const std::uint8_t* data() const { return steps_.data(); }
    /// @return where the cells of a level begin
    [[nodiscard]] std::size_t first_cell(std::size_t depth) const { return first_cell_[depth]; }

    [[nodiscard]] std::size_t bytes() const { return steps_.bytes() + around_.bytes(); }

private:
    std::array<std::size_t, 1 + rebuild::deepest_nesting> first_cell_{};
    rebuild::Buffer<std::uint8_t> steps_, around_;
};

}  // namespace gridreel::traversal
