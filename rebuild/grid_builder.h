#pragma once
// Triangles in, a grid out, from scratch, every frame.

#include "rebuild/build_report.h"
#include "rebuild/cell_mapping.h"
#include "rebuild/grid.h"
#include "rebuild/resolution.h"
#include "rebuild/triangle_view.h"

#include <cstdint>
#include <vector>

namespace gridreel::rebuild {

/// Rebuilds a grid in parallel by counting sort, keeping all memory from one frame to the next:
/// once the largest frame has been seen nothing is allocated.
///
/// Work runs in the calling thread's TBB arena. The grid is byte-identical for any number of threads.
class GridBuilder {
public:
    explicit GridBuilder(const ResolutionPolicy& policy = {});

    /// Builds the grid of `triangles`. Where the resolution rule would list each triangle more than
    /// 64 times on average (long thin triangles across many cells), the grid is made coarser until it does
    /// not.
    BuildReport rebuild(const TriangleView& triangles);

    [[nodiscard]] const Grid& grid() const { return grid_; }

private:
    [[nodiscard]] bool count(const TriangleView& triangles, const CellMapping& mapping);
    void scan();
    void scatter();
    [[nodiscard]] std::size_t bytes() const;

    ResolutionPolicy policy_;
    Grid grid_;
    Buffer<CellRange> ranges_;                       ///< one per triangle
    std::vector<Buffer<std::uint32_t>> histograms_;  ///< one per chunk of triangles, one count per cell
};

}  // namespace gridreel::rebuild
