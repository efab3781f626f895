#pragma once
// What the kernels that walk a grid need to see.

#include "rebuild/grid.h"
#include "rebuild/triangle_view.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>

namespace gridreel::traversal {

/// How far from `origin` the box reaches along any one axis, in metres.
[[nodiscard]] inline double farthest_offset(const rebuild::Bounds3& box, const glm::vec3& origin) {
    double farthest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        farthest = std::max({farthest, double(box.max[axis]) - double(origin[axis]),
                             double(origin[axis]) - double(box.min[axis])});
    }
    return farthest;
}

/// A grid and the triangles it was built from. Borrowed, valid until the next rebuild.
struct GridScene {
    const rebuild::Grid& grid;
    rebuild::TriangleView triangles;
};

}  // namespace gridreel::traversal
