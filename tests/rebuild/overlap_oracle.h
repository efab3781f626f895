#pragma once
// Which cells a triangle comes near, the slow and obvious way.

#include "rebuild/cell_mapping.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace gridreel::rebuild {

using Corners = std::array<glm::vec3, 3>;

/// Whether some point of the triangle lies in the box, faces included: what is left after clipping it by the
/// six faces, in double.
[[nodiscard]] bool overlaps(const Corners& triangle, const glm::dvec3& low, const glm::dvec3& high);

/// The cells, ascending, that the triangle comes within `part` of the mapping's slack of.
[[nodiscard]] std::vector<std::uint32_t> cells_near(const Corners& triangle, const CellMapping& mapping,
                                                    double part);

}  // namespace gridreel::rebuild
