#include "reference_intersection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace gridreel::tests {

std::optional<ReferenceHit> intersect(const Triangles& triangles, std::uint32_t triangle,
                                      const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::uvec3& t = triangles.triangles[triangle];
    const glm::dvec3 a{triangles.positions[t.x]};
    const glm::dvec3 ab = glm::dvec3{triangles.positions[t.y]} - a,
                     ac = glm::dvec3{triangles.positions[t.z]} - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double area = glm::length(normal);
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (!(area > 0.0) || determinant == 0.0) return std::nullopt;

    const glm::dvec3 from_a = origin - a, q = glm::cross(from_a, ab);
    const double u = glm::dot(from_a, p) / determinant, v = glm::dot(direction, q) / determinant;
    const double distance = glm::dot(ac, q) / determinant;
    if (!(distance > 0.0)) return std::nullopt;
    return ReferenceHit{.t = distance,
                        .triangle = triangle,
                        .inside = std::min({u, v, 1.0 - u - v}),
                        .facing = std::fabs(glm::dot(normal, direction)) / (area * glm::length(direction))};
}

std::optional<ReferenceHit> closest(const Triangles& triangles, const glm::dvec3& origin,
                                    const glm::dvec3& direction) {
    std::optional<ReferenceHit> nearest;
    for (std::uint32_t i = 0; i < triangles.triangles.size(); ++i) {
        const auto hit = intersect(triangles, i, origin, direction);
        if (hit && hit->inside >= 0.0 && (!nearest || hit->t < nearest->t)) nearest = hit;
    }
    return nearest;
}

}  // namespace gridreel::tests
