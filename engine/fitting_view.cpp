#include "engine/fitting_view.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace gridreel::engine {
namespace {

constexpr double fov_y_rad = 0.6;       // a portrait lens: little distortion
constexpr double margin = 0.05;         // of the picture's half width and height
constexpr double azimuth_rad = 0.55;    // from +z towards +x
constexpr double elevation_rad = 0.25;  // above the horizon

}  // namespace

View fitting_view(const glm::dvec3& box_min, const glm::dvec3& box_max, std::int32_t width,
                  std::int32_t height) {
    const glm::dvec3 towards_eye{std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
                                 std::cos(azimuth_rad) * std::cos(elevation_rad)};
    View view{.forward = -towards_eye,
              .half_height = std::tan(0.5 * fov_y_rad),
              .near_m = 0.0,
              .far_m = std::numeric_limits<double>::infinity(),
              .pixels_down = double(height)};
    view.right = glm::normalize(glm::cross(view.forward, glm::dvec3(0.0, 1.0, 0.0)));
    view.up = glm::cross(view.right, view.forward);
    view.half_width = view.half_height * width / height;

    // A corner at (x, y, z) from the centre, z along the view, is inside when |x| <= (distance + z) * slope.
    const glm::dvec3 center = 0.5 * (box_min + box_max);
    const double slope_x = view.half_width * (1.0 - margin);
    const double slope_y = view.half_height * (1.0 - margin);
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place{(corner & 1) ? box_max.x : box_min.x, (corner & 2) ? box_max.y : box_min.y,
                               (corner & 4) ? box_max.z : box_min.z};
        const glm::dvec3 arm = place - center;
        const double across = glm::max(std::abs(glm::dot(arm, view.right)) / slope_x,
                                       std::abs(glm::dot(arm, view.up)) / slope_y);
        distance = glm::max(distance, across - glm::dot(arm, view.forward));
    }
    view.eye = center + (distance > 0.0 ? distance : 1.0) * towards_eye;
    return view;
}

}  // namespace gridreel::engine
