#pragma once
// One ray through a uniform grid, cell by cell (Amanatides & Woo 1987).

#include "rebuild/grid.h"
#include "traversal/ray_frame.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// A ray as walks see it, in double: made once, for all grids that the ray goes through.
struct RayLine {
    RayLine(const glm::vec3& from, const RayFrame& ray);

    glm::dvec3 origin;
    glm::dvec3 slope;        ///< metres per metre of depth; never 0
    glm::dvec3 depth_per_m;  ///< its inverse, finite
    double depth_min = 0.0;
    double depth_max = -1.0;  ///< below `depth_min` for a ray that hits nothing
};

/// Where a ray enters a grid, and what it takes to go on from there. Depths are along the ray's K axis, in
/// double, so that the walk itself errs far less than the slack with which triangles are listed in cells.
struct WalkStart {
    /// Cells ahead on the three axes, in fields of one number: a step takes `step_unit`, and a step out of
    /// the grid borrows `out_of_grid`.
    static constexpr std::array<std::uint64_t, 3> step_unit{1, 1 << 21, std::uint64_t{1} << 42};
    static constexpr std::uint64_t out_of_grid =
        std::uint64_t{1} << 20 | std::uint64_t{1} << 41 | std::uint64_t{1} << 62;

    WalkStart(const rebuild::UniformGrid& grid, const RayLine& line);

    bool inside = false;
    double enter_depth = 0.0;
    std::size_t cell = 0;                    ///< of the grid's level
    std::array<double, 3> next_plane{};      ///< depth of the next plane on each axis
    std::array<double, 3> plane_distance{};  ///< depth between planes
    std::array<std::int64_t, 3> stride{};    ///< signed, in cells
    std::uint64_t steps_left = 0;
};

/// Steps from cell to cell along a ray: the plain form of the walk, the oracle of `LaneWalk`.
class RayWalk {
public:
    RayWalk(const rebuild::UniformGrid& grid, const RayLine& line) : at_(grid, line) { find_nearest(); }
    RayWalk(const rebuild::UniformGrid& grid, const glm::vec3& origin, const RayFrame& ray)
        : RayWalk(grid, RayLine(origin, ray)) {}

    [[nodiscard]] bool inside() const { return at_.inside; }
    [[nodiscard]] std::size_t cell() const { return at_.cell; }  ///< of the grid's level

    /// Depth at which the ray leaves the current cell: the nearest of the three planes ahead.
    [[nodiscard]] double exit_depth() const { return at_.next_plane[nearest_]; }

    /// Goes to the next cell, or out of the grid.
    void advance();

private:
    void find_nearest();

    WalkStart at_;
    std::size_t nearest_ = 0;  ///< axis of the nearest plane
};

// Kernels start a walk for every ray and nested grid: worth to be inlined, for their instruction set.
inline WalkStart::WalkStart(const rebuild::UniformGrid& grid, const RayLine& line) {
    if (grid.bounds.empty()) return;
    double enter = line.depth_min;
    double leave = line.depth_max;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double(grid.bounds.min[axis]) - line.origin[axis]) * line.depth_per_m[axis];
        const double b = (double(grid.bounds.max[axis]) - line.origin[axis]) * line.depth_per_m[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (!(enter <= leave)) return;

    // The first cell, and the planes ahead of it.
    const std::array<std::int64_t, 3> strides{
        1, grid.resolution.x, std::int64_t{grid.resolution.x} * std::int64_t{grid.resolution.y}};
    auto first = static_cast<std::int64_t>(grid.first_cell);
    steps_left = out_of_grid;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double low = grid.bounds.min[axis];
        const double at = line.origin[axis] + enter * line.slope[axis];
        const int last = grid.resolution[axis] - 1;
        const int index =
            static_cast<int>(std::min(std::max((at - low) / grid.cell_size[axis], 0.0), double(last)));
        first += index * strides[i];
        const bool up = line.slope[axis] > 0.0;
        const int ahead = up ? last - index : index;
        steps_left += static_cast<std::uint64_t>(ahead) * step_unit[i];
        stride[i] = up ? strides[i] : -strides[i];
        const double plane = low + (index + (up ? 1 : 0)) * grid.cell_size[axis];
        next_plane[i] = (plane - line.origin[axis]) * line.depth_per_m[axis];
        const double size = grid.cell_size[axis] * line.depth_per_m[axis];
        plane_distance[i] = up ? size : -size;
    }
    cell = static_cast<std::size_t>(first);
    inside = true;
    enter_depth = enter;
}

}  // namespace gridreel::traversal
