#pragma once
// Ray against triangle as the textbook has it, in double precision: what the edge functions are held against.

#include "test_triangles.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>

namespace gridreel::tests {

struct ReferenceHit {
    double t = 0.0;
    std::uint32_t triangle = 0;
    double inside = 0.0;  ///< least barycentric coordinate: how clear the hit is
    double facing = 0.0;  ///< |cosine| between ray and normal
};

/// One ray, one triangle (Moeller & Trumbore 1997); hits a little outside count too, with `inside` < 0.
std::optional<ReferenceHit> intersect(const Triangles& triangles, std::uint32_t triangle,
                                      const glm::dvec3& origin, const glm::dvec3& direction);

/// The nearest of all triangles, among hits with `inside` >= 0.
std::optional<ReferenceHit> closest(const Triangles& triangles, const glm::dvec3& origin,
                                    const glm::dvec3& direction);

}  // namespace gridreel::tests
