#pragma once
// How much of its cell each listed triangle takes up.

#include "rebuild/buffer.h"
#include "rebuild/grid.h"
#include "rebuild/triangle_view.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// Places along one axis of a cell, in bytes: the cell reaches from `cell_begin` to `cell_begin + per_cell`,
/// and what lies farther outside counts as at 0 or 255.
struct CellPlace {
    static constexpr float per_cell = 250.0f;
    static constexpr float cell_begin = 2.0f;
};

/// Bounding boxes of triangles within their cells, one for each reference of a grid: six bytes instead of
/// three scattered vertices, so that a ray looks closely only at the triangles that it comes near.
class ReferenceBoxes {
public:
    /// Cells of fewer triangles have no boxes: it is as fast to look at them all.
    static constexpr std::uint32_t least_count = 4;

    /// Bounds of a level's references, in its order: the least and the greatest `CellPlace` along x, y and z,
    /// wider than the triangle by the grid's slack. Meaningless for nested cells and those of
    /// fewer than `least_count`. 31 bytes
    /// behind the last may be read.
    struct Level {
        std::array<const std::uint8_t*, 3> low{}, high{};
    };

    /// Parallel.
    void rebuild(const rebuild::Grid& grid, const rebuild::TriangleView& triangles);

    [[nodiscard]] Level level(std::size_t depth) const;

private:
    struct Places {
        std::array<rebuild::Buffer<std::uint8_t>, 3> low, high;
    };
    std::array<Places, 1 + rebuild::deepest_nesting> levels_;
};

}  // namespace gridreel::traversal
