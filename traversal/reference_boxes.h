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

/// A triangle's bounding box within a cell. The greatest places stand as what they lack to 255, so that one
/// comparison of bytes tells whether a box lies apart from another.
struct ReferenceBox {
    std::array<std::uint8_t, 3> low;  ///< `CellPlace` along x, y and z
    std::uint8_t none = 0;
    std::array<std::uint8_t, 3> below_255;  ///< 255 less the greatest
    std::uint8_t none_either = 0;
};
static_assert(sizeof(ReferenceBox) == 8);

/// Bounding boxes of triangles within their cells, one for each reference of a grid: eight bytes in a row
/// instead of three scattered vertices, so that a ray looks closely only at the triangles that it comes near.
class ReferenceBoxes {
public:
    /// Parallel.
    void rebuild(const rebuild::Grid& grid, const rebuild::TriangleView& triangles);

    /// Boxes of a level's references, in its order, wider than the triangle by the grid's slack; meaningless
    /// for nested cells. 64 bytes behind the last may be read.
    [[nodiscard]] const ReferenceBox* level(std::size_t depth) const { return levels_[depth].data(); }

    [[nodiscard]] std::size_t bytes() const;

private:
    std::array<rebuild::Buffer<ReferenceBox>, 1 + rebuild::deepest_nesting> levels_;
};

}  // namespace gridreel::traversal
