#pragma once
// What a rebuild remembers of the grid before it, where triangles have stood still since.

#include "rebuild/bounds.h"
#include "rebuild/buffer.h"
#include "rebuild/grid.h"
#include "rebuild/still_triangles.h"
#include "rebuild/triangle_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace gridreel::rebuild {

/// Where a nested grid is, and how it came out.
struct NestedGrid {
    std::uint32_t parent = 0;            ///< grid of the level above
    std::uint32_t cell = 0;              ///< of its parent: its place
    std::uint32_t displaced[2] = {};     ///< references that its mark lies on
    std::optional<std::uint32_t> was{};  ///< number of the same grid in the frame before
    bool still = false;                  ///< the cell lists triangles that never move, and nothing else
    bool dropped = false;                ///< had too many references, so its cells are empty
};

/// Says which lists of the last frame's grid are those of the next one. They lie where they were, in the
/// levels of the grid: remembering them takes no memory but where the grids were.
///
/// Which cells a triangle is listed in depends on its corners and on the grid's box and resolution alone. So
/// in a top grid with the very same cells still triangles are in the same lists; and a cell that lists
/// nothing else becomes the same nested grid again, with all that is nested in it.
class LastFrame {
public:
    /// Begins the next frame; what is remembered of the one before is now the last. Takes the last frame's
    /// grids, but leaves its lists where they are. If those are of any use, puts the references back that the
    /// marks of nested grids lie on.
    /// @param grid    as the last frame left it
    /// @param lambda  the next frame's
    /// @throws std::invalid_argument if what is known is of another number of triangles
    void begin(const TriangleView& triangles, float lambda, Grid& grid);

    /// The frame is whole. Of one that never came so far nothing is used.
    void end() { whole_ = true; }

    /// The grid's memory was let go.
    void forget() { *this = {}; }

    /// The animation's still triangles, if something is to be remembered; nullptr: nothing is.
    [[nodiscard]] const StillTriangles* still() const { return still_.get(); }

    /// The box of those of them that can be hit.
    std::optional<Bounds3> still_box;

    /// Compares the frame's top grid, which is the one that was compared last, with the last frame's.
    /// @return whether it has the same cells, with the same still triangles
    [[nodiscard]] bool compare_top(const UniformGrid& grid);

    /// The number of the grid that the last frame had in this cell, if what the cell lists is the same.
    /// @param next  has its place, and whether it is `still`
    [[nodiscard]] std::optional<std::uint32_t> same_as(std::size_t depth, const NestedGrid& next) const;

    /// What the last frame had nested on this level.
    [[nodiscard]] const NestedGrid& last(std::size_t depth, std::uint32_t number) const {
        return last_[depth][number];
    }
    [[nodiscard]] const UniformGrid& last_grid(std::size_t depth, std::uint32_t number) const {
        return last_grids_[depth][number];
    }

    /// What the frame has nested on this level, ascending by parent and cell.
    [[nodiscard]] Buffer<NestedGrid>& nested(std::size_t depth) { return now_[depth]; }

    [[nodiscard]] std::size_t bytes() const;
    /// Of those, what the last two frames needed.
    [[nodiscard]] std::size_t used_bytes() const;

private:
    /// By depth; nothing is nested on the first.
    using NestedGrids = std::array<Buffer<NestedGrid>, 1 + deepest_nesting>;

    std::shared_ptr<const StillTriangles> still_;
    float lambda_ = 0.0f;
    bool whole_ = false;
    bool known_ = false;     ///< the last frame showed the same animation
    bool same_top_ = false;  ///< and this frame's top grid has the same cells
    NestedGrids last_, now_;
    std::array<Buffer<UniformGrid>, 1 + deepest_nesting> last_grids_;
};

}  // namespace gridreel::rebuild
