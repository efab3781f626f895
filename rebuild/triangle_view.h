#pragma once
// The language between whoever makes triangles and whoever builds structures over them.

#include "rebuild/still_triangles.h"

#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <span>

namespace gridreel::rebuild {

/// Coordinates beyond this are not traced: the volumes that intersection computes would overflow a float.
inline constexpr float largest_coordinate = 1e12f;

[[nodiscard]] inline bool is_traceable(const glm::vec3& p) {
    return std::fabs(p.x) <= largest_coordinate && std::fabs(p.y) <= largest_coordinate &&
           std::fabs(p.z) <= largest_coordinate;
}

/// Indexed triangles that somebody else owns. Indices are in range; positions may be anything:
/// a triangle with a corner that is not traceable (NaN, infinite or beyond 1e12) is never hit.
struct TriangleView {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> triangles;
    /// Those that stand still from frame to frame; nullptr: nothing is known. What is rebuilt never depends
    /// on it, only how soon.
    std::shared_ptr<const StillTriangles> still = nullptr;

    [[nodiscard]] std::size_t size() const { return triangles.size(); }
};

}  // namespace gridreel::rebuild
