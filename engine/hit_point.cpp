#include "engine/hit_point.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace gridreel::engine {
namespace {

/// Weights of the corners where the ray meets the triangle's plane (Möller & Trumbore 1997), forced inside.
glm::dvec3 barycentric(const std::array<glm::vec3, 3>& corners, const Ray& ray) {
    const glm::dvec3 a(corners[0]);
    const glm::dvec3 ab = glm::dvec3(corners[1]) - a;
    const glm::dvec3 ac = glm::dvec3(corners[2]) - a;
    const glm::dvec3 direction(ray.direction);
    const glm::dvec3 p = glm::cross(direction, ac);
    const glm::dvec3 arm = glm::dvec3(ray.origin) - a;
    const double volume = glm::dot(ab, p);
    const double b = glm::dot(arm, p) / volume;
    const double c = glm::dot(direction, glm::cross(arm, ab)) / volume;
    if (!std::isfinite(b) || !std::isfinite(c)) return glm::dvec3(1.0 / 3.0);  // seen edge-on

    const double weight_b = glm::clamp(b, 0.0, 1.0);
    const double weight_c = glm::clamp(c, 0.0, 1.0 - weight_b);
    return {1.0 - weight_b - weight_c, weight_b, weight_c};
}

template <class T>
T interpolated(const std::vector<T>& values, const glm::uvec3& triangle, const HitPoint& point) {
    const glm::vec3 w(point.weights);
    return w.x * values[triangle.x] + w.y * values[triangle.y] + w.z * values[triangle.z];
}

}  // namespace

HitPoint hit_point(const anim::FrameGeometry& geometry, std::uint32_t triangle, const Ray& ray) {
    const glm::uvec3 vertices = geometry.triangles[triangle];
    HitPoint point{.corners = {geometry.positions[vertices.x], geometry.positions[vertices.y],
                               geometry.positions[vertices.z]}};
    point.weights = barycentric(point.corners, ray);

    const glm::dvec3 a(point.corners[0]);
    const glm::dvec3 ab = glm::dvec3(point.corners[1]) - a;
    const glm::dvec3 ac = glm::dvec3(point.corners[2]) - a;
    point.position = a + point.weights.y * ab + point.weights.z * ac;
    point.area_normal = glm::cross(ab, ac);
    if (geometry.mirrored[geometry.triangle_part[triangle]]) point.area_normal = -point.area_normal;
    point.side = glm::dot(point.area_normal, glm::dvec3(ray.direction)) > 0.0 ? Side::back : Side::front;
    return point;
}

glm::vec2 texcoord_at(const anim::FrameGeometry& geometry, std::uint32_t triangle, const HitPoint& point,
                      std::uint32_t set) {
    const auto& values = geometry.texcoords[set];
    return values.empty() ? glm::vec2(0.0f) : interpolated(values, geometry.triangles[triangle], point);
}

glm::vec4 color_at(const anim::FrameGeometry& geometry, std::uint32_t triangle, const HitPoint& point) {
    return geometry.colors.empty() ? glm::vec4(1.0f)
                                   : interpolated(geometry.colors, geometry.triangles[triangle], point);
}

}  // namespace gridreel::engine
