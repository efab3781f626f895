#include "overlap_oracle.h"

#include <cmath>

namespace gridreel::rebuild {
namespace {

/// What of the polygon lies where sign * p[axis] <= sign * at.
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, int axis, double sign, double at) {
    std::vector<glm::dvec3> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
        const double from_in = sign * (at - from[axis]), to_in = sign * (at - to[axis]);
        if (from_in >= 0.0) inside.push_back(from);
        if ((from_in < 0.0) == (to_in < 0.0)) continue;
        glm::dvec3 crossing = from + (to - from) * (from_in / (from_in - to_in));
        crossing[axis] = at;
        inside.push_back(crossing);
    }
    return inside;
}

}  // namespace

bool overlaps(const Corners& triangle, const glm::dvec3& low, const glm::dvec3& high) {
    std::vector<glm::dvec3> polygon{triangle[0], triangle[1], triangle[2]};
    for (int axis = 0; axis < 3; ++axis) {
        polygon = clipped(polygon, axis, 1.0, high[axis]);
        polygon = clipped(polygon, axis, -1.0, low[axis]);
    }
    return !polygon.empty();
}

std::vector<std::uint32_t> cells_near(const Corners& triangle, const CellMapping& mapping, double part) {
    const glm::ivec3 cells = mapping.resolution();
    std::vector<std::uint32_t> near;
    std::uint32_t number = 0;
    for (int z = 0; z < cells.z; ++z) {
        for (int y = 0; y < cells.y; ++y) {
            for (int x = 0; x < cells.x; ++x, ++number) {
                const glm::dvec3 corner =
                    glm::dvec3{mapping.origin()} + glm::dvec3{x, y, z} * mapping.cell_size();
                const glm::dvec3 by = part * mapping.slack();
                if (overlaps(triangle, corner - by, corner + mapping.cell_size() + by))
                    near.push_back(number);
            }
        }
    }
    return near;
}

}  // namespace gridreel::rebuild
