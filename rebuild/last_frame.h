#pragma once
// What a rebuild remembers of the grid before it, where triangles have stood still since.

#include "rebuild/bounds.h"
#include "rebuild/grid.h"
#include "rebuild/still_triangles.h"
#include "rebuild/triangle_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace gridreel::rebuild {

/// A nested grid as it came out, and where it is.
struct NestedGrid {
    std::uint32_t parent = 0;            ///< grid of the level above
    std::size_t cell = 0;                ///< of its parent: its place
    bool still = false;                  ///< the cell lists triangles that never move, and nothing else
    bool dropped = false;                ///< had too many references, so its cells are empty
    std::optional<std::uint32_t> was{};  ///< number of the same grid in the frame before
    std::uint32_t displaced[2] = {};     ///< references that its mark lies on
    UniformGrid grid{};
};

/// Says which lists of the last frame's grid are those of the next one. They lie where they were, in the
/// levels of the grid: remembering them takes no memory but a few numbers for each nested grid.
///
/// Which cells a triangle is listed in depends on its corners and on the grid's box and resolution alone. So
/// in a top grid with the very same cells still triangles are in the same lists; and a cell that lists
/// nothing else becomes the same nested grid again, with all that is nested in it.
class LastFrame {
public:
    /// Begins the next frame; what is remembered of the one before is now the last. If that is of any use,
    /// puts the references back that the marks of nested grids lie on.
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

    /// Whether a grid has the same cells as the last frame's top grid, with the same still triangles.
    [[nodiscard]] bool same_top(const UniformGrid& grid) const;

    /// Remembers the frame's top grid.
    void set_top(const UniformGrid& grid);

    /// The number of the grid that the last frame had in this cell, if what the cell lists is the same.
    /// @param next  has its place, and whether it is `still`
    [[nodiscard]] std::optional<std::uint32_t> same_as(std::size_t depth, const NestedGrid& next) const;

    /// What the last frame had nested on this level.
    [[nodiscard]] const NestedGrid& last(std::size_t depth, std::uint32_t number) const {
        return last_.nested[depth][number];
    }

    /// What the frame has nested on this level, ascending by parent and cell.
    [[nodiscard]] std::vector<NestedGrid>& nested(std::size_t depth) { return now_.nested[depth]; }

    [[nodiscard]] std::size_t bytes() const;

private:
    struct Shape {
        UniformGrid top;
        std::array<std::vector<NestedGrid>, 1 + deepest_nesting> nested;  ///< the first has none
    };

    std::shared_ptr<const StillTriangles> still_;
    float lambda_ = 0.0f;
    bool whole_ = false;
    bool known_ = false;     ///< the last frame showed the same animation
    bool same_top_ = false;  ///< and this frame's top grid has the same cells
    Shape last_, now_;
};

}  // namespace gridreel::rebuild
