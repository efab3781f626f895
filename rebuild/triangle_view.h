#pragma once
// The language between whoever makes triangles and whoever builds structures over them.

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

namespace gridreel::rebuild {

/// Indexed triangles that somebody else owns. Indices are in range; positions may be anything:
/// a triangle with a non-finite corner is never hit.
struct TriangleView {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> triangles;

    [[nodiscard]] std::size_t size() const { return triangles.size(); }
};

}  // namespace gridreel::rebuild
