#pragma once
// Triangles in, a grid out, from scratch, every frame.

#include "rebuild/build_report.h"
#include "rebuild/grid.h"
#include "rebuild/last_frame.h"
#include "rebuild/level_sort.h"
#include "rebuild/resolution.h"
#include "rebuild/triangle_view.h"

#include <vector>

namespace gridreel::rebuild {

/// Rebuilds a grid in parallel by counting sort, keeping all memory from one frame to the next:
/// once the largest frame has been seen nothing is allocated, until frames have long needed less than half.
/// Where triangles are known to stand still (`TriangleView::still`) it takes over what the last frame's lists
/// say of them; the grid is the same byte for byte.
///
/// Work runs in the calling thread's TBB arena. The grid is byte-identical for any number of threads.
class GridBuilder {
public:
    /// @param policy  more than 2^31 `max_cells` are taken as so many
    explicit GridBuilder(const ResolutionPolicy& policy = {});

    /// Builds the grid of `triangles`, of which there are fewer than 2^31.
    ///
    /// Where the resolution rule would list each triangle more than 64 times on average (long thin triangles
    /// across many cells), the grid is made coarser until it does not. A cell becomes a grid by the same
    /// rule, in the tight box of what it holds, at most `deepest_nesting` deep, if it holds more than
    /// `nest_above` triangles and 16 min(1, lambda)^1.5 times as many as those of its grid that are not empty
    /// do on average, unless that would list each of them more than 4 max(1, lambda)^(2/3) times.
    ///
    /// @throws std::length_error for 2^31 triangles or more
    /// @throws std::invalid_argument for `still` of another number of triangles
    BuildReport rebuild(const TriangleView& triangles);

    /// Cells per triangle from the next rebuild on.
    /// @throws std::invalid_argument unless finite and greater than 0
    void set_lambda(float lambda);

    [[nodiscard]] const Grid& grid() const { return grid_; }

private:
    [[nodiscard]] Bounds3 measure(const TriangleView& triangles);
    void build_top(const TriangleView& triangles, const Bounds3& box, BuildReport& report);
    [[nodiscard]] GridJob top_job(std::size_t triangles, const StillTriangles* known) const;
    [[nodiscard]] bool nest(const TriangleView& triangles, std::size_t depth, BuildReport& report);
    void measure_nested(const TriangleView& triangles, std::size_t depth);
    [[nodiscard]] UniformGrid nested_grid(const TriangleView& triangles, const UniformGrid& parent,
                                          std::size_t cell, const TriangleList& list) const;
    [[nodiscard]] bool take_over(std::size_t depth, std::size_t index, const TriangleList& list);
    void mark_nested(std::size_t depth);
    void release();
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] std::size_t used_bytes() const;

    ResolutionPolicy policy_;
    Grid grid_;
    LevelSort sort_;
    LastFrame last_frame_;
    std::vector<GridJob> jobs_;  ///< of the level being built
    std::vector<CrowdedCell> crowded_;
    int oversized_ = 0;  ///< frames in a row that needed less than half of the memory
};

}  // namespace gridreel::rebuild
