#include "traversal/ray_walk.h"

#include "rebuild/triangle_view.h"
#include "traversal/rounding.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridreel::traversal {

RayWalk::RayWalk(const rebuild::UniformGrid& grid, const glm::vec3& origin, const RayFrame& ray) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (grid.bounds.empty() || ray.hits_nothing() || !rebuild::is_traceable(origin)) return;

    glm::dvec3 slope{0.0};
    slope[ray.axes.k] = ray.axes.sign();
    slope[ray.axes.u()] = ray.slope_u;
    slope[ray.axes.v()] = ray.slope_v;

    // Clip the ray against the box.
    // A hit just behind depth_min may be rounded beyond it from a cell before.
    double enter = double(ray.depth_min) * (1.0 - depth_error);
    double leave = ray.depth_max;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = double(grid.bounds.min[axis]) - double(origin[axis]);
        const double high = double(grid.bounds.max[axis]) - double(origin[axis]);
        if (slope[axis] == 0.0) {
            if (low > 0.0 || high < 0.0) return;
            continue;
        }
        const double a = low / slope[axis];
        const double b = high / slope[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (!(enter <= leave)) return;

    // The first cell, and the planes ahead of it.
    const std::array<std::ptrdiff_t, 3> strides{
        1, grid.resolution.x, std::ptrdiff_t{grid.resolution.x} * std::ptrdiff_t{grid.resolution.y}};
    auto cell = static_cast<std::ptrdiff_t>(grid.first_cell);
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const double low = grid.bounds.min[axis];
        const double at = double(origin[axis]) + enter * slope[axis];
        const int last = grid.resolution[axis] - 1;
        const int index =
            static_cast<int>(std::clamp(std::floor((at - low) / grid.cell_size[axis]), 0.0, double(last)));
        cell += index * strides[i];
        const bool up = slope[axis] > 0.0;
        steps_left_[i] = up ? last - index : index;
        stride_[i] = up ? strides[i] : -strides[i];
        if (slope[axis] == 0.0) {
            next_plane_[i] = plane_distance_[i] = infinity;
            continue;
        }
        const double plane = low + (index + (up ? 1 : 0)) * grid.cell_size[axis];
        next_plane_[i] = (plane - double(origin[axis])) / slope[axis];
        plane_distance_[i] = grid.cell_size[axis] / std::fabs(slope[axis]);
    }
    cell_ = static_cast<std::size_t>(cell);
    inside_ = true;
    find_nearest();
}

void RayWalk::advance() {
    if (steps_left_[nearest_]-- == 0) {
        inside_ = false;
        return;
    }
    cell_ = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell_) + stride_[nearest_]);
    next_plane_[nearest_] += plane_distance_[nearest_];
    find_nearest();
}

void RayWalk::find_nearest() {
    nearest_ = next_plane_[0] <= next_plane_[1] ? 0 : 1;
    if (next_plane_[2] < next_plane_[nearest_]) nearest_ = 2;
}

}  // namespace gridreel::traversal
