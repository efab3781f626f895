#include "traversal/ray_walk.h"

#include "rebuild/triangle_view.h"
#include "traversal/rounding.h"

namespace gridreel::traversal {
namespace {

/// Stands for a slope of 0: its inverse times any distance between two floats is still finite, and but for
/// a distance of 0 beyond any grid.
constexpr double no_slope = 1e-100;

}  // namespace

RayLine::RayLine(const glm::vec3& from, const RayFrame& ray) : origin(from), slope(1.0), depth_per_m(1.0) {
    if (ray.hits_nothing() || !rebuild::is_traceable(from)) return;
    slope[ray.axes.k] = ray.axes.sign();
    slope[ray.axes.u()] = ray.slope_u == 0.0f ? no_slope : double(ray.slope_u);
    slope[ray.axes.v()] = ray.slope_v == 0.0f ? no_slope : double(ray.slope_v);
    depth_per_m = 1.0 / slope;
    // A hit just behind depth_min may be rounded beyond it from a cell before.
    depth_min = double(ray.depth_min) * (1.0 - depth_error);
    depth_max = double(ray.depth_max) * (1.0 + depth_error);  // a hit may have been rounded nearer
}

void RayWalk::advance() {
    at_.steps_left -= WalkStart::step_unit[nearest_];
    if ((at_.steps_left & WalkStart::out_of_grid) != WalkStart::out_of_grid) {
        at_.inside = false;
        return;
    }
    at_.cell = static_cast<std::size_t>(static_cast<std::int64_t>(at_.cell) + at_.stride[nearest_]);
    at_.next_plane[nearest_] += at_.plane_distance[nearest_];
    find_nearest();
}

void RayWalk::find_nearest() {
    nearest_ = at_.next_plane[0] <= at_.next_plane[1] ? 0 : 1;
    if (at_.next_plane[2] < at_.next_plane[nearest_]) nearest_ = 2;
}

}  // namespace gridreel::traversal
