#include "engine/camera.h"

#include "anim/error.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace gridreel::engine {
namespace {

/// @throws Error when `axis` has no direction
glm::dvec3 direction_of(const glm::dvec3& axis, std::string_view node) {
    // Scaled first, so that tiny and huge matrices keep their direction.
    const double largest = glm::max(std::abs(axis.x), glm::max(std::abs(axis.y), std::abs(axis.z)));
    if (!(largest > 0.0) || !std::isfinite(largest)) {
        throw Error("the camera's node has no orientation: its matrix is singular or not finite", node,
                    "give the node a scale other than zero");
    }
    return glm::normalize(axis / largest);
}

}  // namespace

glm::dvec3 View::on_picture_plane(const glm::dvec2& place) const {
    // Square pixels: the height's scale serves both axes.
    const double metres_per_pixel = 2.0 * half_height / pixels_down;
    const double x = place.x * metres_per_pixel - half_width;
    const double y = half_height - place.y * metres_per_pixel;
    return x * right + y * up;
}

glm::vec3 View::ray_origin(const glm::dvec2& place) const {
    if (kind == anim::Camera::Kind::perspective) return glm::vec3(eye);
    return glm::vec3(eye + on_picture_plane(place));
}

glm::vec3 View::ray_direction(const glm::dvec2& place) const {
    if (kind == anim::Camera::Kind::orthographic) return glm::vec3(forward);
    return glm::vec3(forward + on_picture_plane(place));
}

double View::depth(const glm::dvec3& point) const {
    return glm::dot(point - eye, forward);
}

glm::vec3 View::towards_viewer(const glm::dvec3& point) const {
    if (kind == anim::Camera::Kind::orthographic) return glm::vec3(-forward);
    const glm::dvec3 way = eye - point;
    const double distance = glm::length(way);
    return glm::vec3(distance > 0.0 ? way / distance : -forward);
}

double View::pixel_width(double depth_m) const {
    const double width = 2.0 * half_height / pixels_down;
    return kind == anim::Camera::Kind::perspective ? width * depth_m : width;
}

View view_of(const anim::Camera& camera, const glm::dmat4& world, std::int32_t width, std::int32_t height,
             std::string_view node) {
    View view{.kind = camera.kind,
              .eye = glm::dvec3(world[3]),
              .forward = direction_of(-glm::dvec3(world[2]), node),
              .half_height = camera.kind == anim::Camera::Kind::perspective ? std::tan(0.5 * camera.fov_y_rad)
                                                                            : std::abs(camera.y_mag),
              .near_m = camera.near_m,
              .far_m = camera.far_m,
              .pixels_down = double(height)};
    view.right = direction_of(glm::cross(view.forward, direction_of(glm::dvec3(world[1]), node)), node);
    view.up = glm::cross(view.right, view.forward);
    view.half_width = view.half_height * width / height;
    return view;
}

}  // namespace gridreel::engine
