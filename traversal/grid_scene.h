#pragma once
// What the kernels that walk a grid need to see.

#include "rebuild/grid.h"
#include "rebuild/triangle_view.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace gridreel::traversal {

/// A grid and the triangles it was built from. Borrowed, valid until the next rebuild.
struct GridScene {
    const rebuild::Grid& grid;
    rebuild::TriangleView triangles;

    [[nodiscard]] const glm::vec3& corner(std::uint32_t triangle, int which) const {
        return triangles.positions[triangles.triangles[triangle][which]];
    }
};

}  // namespace gridreel::traversal
