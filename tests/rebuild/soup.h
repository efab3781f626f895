#pragma once
// Triangles to build a grid of.

#include "rebuild/triangle_view.h"

#include <glm/vec3.hpp>

#include <vector>

namespace gridreel::rebuild {

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    [[nodiscard]] TriangleView view() const { return {positions, triangles}; }
};

}  // namespace gridreel::rebuild
