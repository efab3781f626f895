#pragma once
// Choosing how many cells a uniform grid gets along each axis.

#include "rebuild/bounds.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// What the caller may tune. Plain data: copy it, print it, log it.
struct ResolutionPolicy {
    float lambda = 1.0f;                     ///< cells per triangle, > 0; the paper's best was 5
    std::int32_t max_cells_per_axis = 1024;  ///< in [1, 65535]; bounds memory on thin scenes
    std::int64_t max_cells = 1 << 27;        ///< >= 1; over all three axes
    std::uint32_t nest_above = 128;          ///< only cells of more triangles become grids; 0: none does
    bool heed_still = true;                  ///< take over lists of triangles known to stand still
};

/// Grid resolution for `triangle_count` triangles inside `world`.
///
/// n_k = d_k * cbrt(lambda * N / V) (Wald et al. 2006, section 4): d the box extent,
/// V its volume. A flat box gets one cell on its flat axis, and the rule in two dimensions on the others.
///
/// @param world  scene box in metres, finite or empty
/// @return cells per axis, each in [1, max_cells_per_axis], their product at most max_cells
/// @throws std::invalid_argument when `policy` breaks its stated ranges
///
/// Pure: same answer on every machine and thread count.
[[nodiscard]] glm::ivec3 choose_resolution(const Bounds3& world, std::size_t triangle_count,
                                           const ResolutionPolicy& policy = {});

}  // namespace gridreel::rebuild
