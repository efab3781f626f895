#pragma once
// One ray through a uniform grid, cell by cell (Amanatides & Woo 1987).

#include "rebuild/grid.h"
#include "traversal/ray_frame.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace gridreel::traversal {

/// Steps from cell to cell along a ray. Depths are along the ray's K axis, in double, so that the walk itself
/// errs far less than the slack with which triangles are listed in cells.
class RayWalk {
public:
    RayWalk(const rebuild::UniformGrid& grid, const glm::vec3& origin, const RayFrame& ray);

    [[nodiscard]] bool inside() const { return inside_; }
    [[nodiscard]] std::size_t cell() const { return cell_; }  ///< of the grid's level

    /// Depth at which the ray leaves the current cell: the nearest of the three planes ahead.
    [[nodiscard]] double exit_depth() const { return next_plane_[nearest_]; }

    /// Goes to the next cell, or out of the grid.
    void advance();

private:
    void find_nearest();

    bool inside_ = false;
    std::size_t cell_ = 0;
    std::size_t nearest_ = 0;                 ///< axis of the nearest plane
    std::array<double, 3> next_plane_{};      ///< depth of the next plane on each axis
    std::array<double, 3> plane_distance_{};  ///< depth between planes
    std::array<int, 3> steps_left_{};         ///< cells ahead on each axis
    std::array<std::ptrdiff_t, 3> stride_{};  ///< signed, in cells
};

}  // namespace gridreel::traversal
