#pragma once
// What a ray on its own has hit so far, and its answer in the end.

#include "traversal/ray_batch.h"
#include "traversal/ray_frame.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace gridreel::traversal {

struct DepthHit {
    float depth = 0.0f;  ///< the ray's depth_max on a miss
    std::uint32_t triangle = no_triangle;
};

/// Whether the ray meets a triangle within its reach: behind what it has gone through, before its end.
[[nodiscard]] inline bool counts(const RayFrame& ray, const DepthHit& met) {
    const bool begun = met.depth > ray.depth_min || (met.depth == ray.depth_min && met.triangle > ray.after);
    return begun && met.depth < ray.depth_max;
}

/// Of triangles at the same depth the lowest index wins.
[[nodiscard]] inline bool comes_before(const DepthHit& a, const DepthHit& b) {
    return a.depth < b.depth || (a.depth == b.depth && a.triangle < b.triangle);
}

inline void store(const RayFrame& ray, const DepthHit& hit, std::size_t place, HitBatch& hits) {
    const bool missed = hit.triangle == no_triangle;
    hits.t[place] = missed ? std::numeric_limits<float>::infinity() : ray.t_of(hit.depth);
    hits.triangle[place] = hit.triangle;
}

inline void store(const RayFrame& /*ray*/, const DepthHit& hit, std::size_t place, OcclusionBatch& occluded) {
    occluded[place] = hit.triangle != no_triangle;
}

}  // namespace gridreel::traversal
