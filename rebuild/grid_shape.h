#pragma once
// Where grids and their cells lie: around what they hold, as fine as a policy says.

#include "rebuild/bounds.h"
#include "rebuild/grid.h"
#include "rebuild/reference_kernel.h"
#include "rebuild/resolution.h"
#include "rebuild/triangle_view.h"

#include <cstddef>

namespace gridreel::rebuild {

/// The box of all triangles of the list that can be hit, found in parallel. Vertices that no triangle uses do
/// not stretch it.
[[nodiscard]] Bounds3 traceable_bounds(const TriangleView& view, const TriangleList& list);

/// A grid around a box that is not empty, for so many triangles; its cells have no place yet.
[[nodiscard]] UniformGrid grid_in(const Bounds3& box, std::size_t triangles, const ResolutionPolicy& policy,
                                  double least_slack);

/// The box of one cell, as far as a walk may take a point to be in it.
/// @param cell  of the grid
[[nodiscard]] Bounds3 box_of_cell(const UniformGrid& grid, std::size_t cell);

}  // namespace gridreel::rebuild
