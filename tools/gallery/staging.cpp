#include "tools/gallery/staging.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>

namespace gridreel::gallery {

namespace {

constexpr double pi = 3.141592653589793;

/// Six significant digits or so: the file need not carry more.
double rounded(double x) {
    return std::floor(x * 1e6 + 0.5) / 1e6;
}

}  // namespace

Id add_camera(Document& document, const glm::dvec3& eye, const glm::dvec3& target, double fov_y_degrees,
              double far_m) {
    const Id camera =
        append(document.cameras, Camera{.fov_y_rad = rounded(fov_y_degrees * pi / 180.0), .far_m = far_m});

    // A camera looks along -z.
    const glm::dvec3 back = glm::normalize(eye - target);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), back));
    const glm::dquat turn = glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back));
    return append(
        document.nodes,
        Node{.name = "camera", .translation = eye, .rotation = glm::normalize(turn), .camera = camera});
}

Id add_light(Document& document, std::string name, const glm::dvec3& position, const glm::dvec3& subject,
             double radiance, const glm::dvec3& color) {
    const glm::dvec3 way = subject - position;
    const Id light =
        append(document.lights, PointLight{.name = name,
                                           .color = color,
                                           .intensity_cd = rounded(radiance * pi * glm::dot(way, way))});
    return append(document.nodes, Node{.name = std::move(name), .translation = position, .light = light});
}

}  // namespace gridreel::gallery
