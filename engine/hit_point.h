#pragma once
// Where exactly a ray meets the triangle it is known to hit.

#include "anim/frame_geometry.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>

namespace gridreel::engine {

struct Ray {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f, 0.0f, -1.0f};
};

enum class Side { front, back };

/// A point of a triangle. It follows from ray and triangle alone, in double precision, and not from the
/// tracer's t: pictures do not depend on how a tracer rounds.
struct HitPoint {
    std::array<glm::vec3, 3> corners;  ///< world space, metres
    glm::dvec3 weights{0.0};      ///< barycentric, each in [0, 1], sum 1: inside even if the ray just misses
    glm::dvec3 position{0.0};     ///< world space, metres
    glm::dvec3 area_normal{0.0};  ///< towards the front side; twice the triangle's area long
    Side side = Side::front;      ///< the one the ray meets; seen edge-on: the front
};

/// The front is where the winding is counter-clockwise, under mirrored nodes clockwise
/// (glTF 2.0, section 3.7.4).
[[nodiscard]] HitPoint hit_point(const anim::FrameGeometry& geometry, std::uint32_t triangle, const Ray& ray);

/// Vertex attributes at the point.
[[nodiscard]] glm::vec2 texcoord_at(const anim::FrameGeometry& geometry, std::uint32_t triangle,
                                    const HitPoint& point, std::uint32_t set);
[[nodiscard]] glm::vec4 color_at(const anim::FrameGeometry& geometry, std::uint32_t triangle,
                                 const HitPoint& point);

}  // namespace gridreel::engine
