#pragma once
// What the kernels that walk a grid need to see.

#include "rebuild/grid.h"
#include "rebuild/macrocells.h"
#include "rebuild/triangle_view.h"
#include "traversal/packet_options.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstdint>

namespace gridreel::traversal {

/// How far off corners in the box are at most, in metres along any one axis, once they are rounded relative
/// to `origin`.
[[nodiscard]] inline double corner_error(const rebuild::Bounds3& box, const glm::vec3& origin) {
    double farthest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        farthest = std::max({farthest, double(box.max[axis]) - double(origin[axis]),
                             double(origin[axis]) - double(box.min[axis])});
    }
    return farthest * 0x1p-23;
}

/// A grid, the triangles it was built from, and how to go through it. Borrowed, valid until the next rebuild.
struct GridScene {
    const rebuild::Grid& grid;
    rebuild::TriangleView triangles;
    PacketOptions packets{};
    const rebuild::Macrocells* macrocells = nullptr;  ///< of the grid; none: do not skip
};

}  // namespace gridreel::traversal
