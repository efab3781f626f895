#pragma once
// What a rebuild cost.

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// Cost and size of one rebuild. Structures without cells or references report zeros.
struct BuildReport {
    double bounds_ms = 0.0;          ///< wall clock, box of the triangles and resolution
    double count_ms = 0.0;           ///< finding references, and histograms
    double scan_ms = 0.0;            ///< prefix sums
    double scatter_ms = 0.0;         ///< writing the reference lists
    double nesting_ms = 0.0;         ///< grids in crowded cells, all of their phases
    double total_ms = 0.0;           ///< everything, start to end
    float lambda = 0.0f;             ///< cells per triangle asked for
    glm::ivec3 resolution{0};        ///< cells per axis of the top grid
    std::uint64_t cells = 0;         ///< of all grids
    std::uint64_t references = 0;    ///< triangles over all cell lists
    std::uint64_t nested_grids = 0;  ///< in crowded cells
    std::size_t bytes = 0;           ///< structure and scratch memory held
};

}  // namespace gridreel::rebuild
