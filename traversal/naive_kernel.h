#pragma once
// The inner loop of the naive tracer, chosen for the machine's SIMD instructions at run time.

#include "traversal/depth_hit.h"
#include "traversal/ray_frame.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// Triangles one after another, corner by corner: x of all A, y of all A, …, z of all C.
struct CornerRuns {
    const float* data = nullptr;  ///< 9 * padded floats
    std::size_t count = 0;        ///< triangles
    std::size_t padded = 0;       ///< length of a run, a multiple of `naive_padding`; NaN beyond `count`
};

inline constexpr std::size_t naive_padding = 16;

[[nodiscard]] DepthHit closest_of_all(const CornerRuns& corners, const glm::vec3& origin,
                                      const RayFrame& ray);

}  // namespace gridreel::traversal
