#pragma once
// The one form in which every tracer sees a ray: slopes relative to its dominant axis.

#include "traversal/ray_batch.h"

#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gridreel::traversal {

/// The three axes of a ray's frame: K, along which the ray runs most, and U, V, cyclically after it.
struct Axes {
    int k = 0;
    bool negative = false;  ///< the ray runs down the K axis

    [[nodiscard]] int u() const { return k == 2 ? 0 : k + 1; }
    [[nodiscard]] int v() const { return k == 0 ? 2 : k - 1; }
    [[nodiscard]] float sign() const { return negative ? -1.0f : 1.0f; }
    [[nodiscard]] unsigned face() const { return 2u * static_cast<unsigned>(k) + (negative ? 1u : 0u); }

    friend bool operator==(const Axes&, const Axes&) = default;
};

inline constexpr unsigned face_count = 6;

[[nodiscard]] inline Axes axes_of_face(unsigned face) {
    return {.k = static_cast<int>(face / 2), .negative = (face & 1u) != 0};
}

/// A ray in its own frame: after depth `s` along K it stands at (s * slope_u, s * slope_v) from its origin.
/// Depth is always measured forwards. Slopes are in [-1, 1].
struct RayFrame {
    Axes axes;
    float slope_u = 0.0f;
    float slope_v = 0.0f;
    float depth_per_t = 0.0f;  ///< |d_K|; 0: the ray hits nothing
    float depth_min = 0.0f;    ///< open interval in which a hit counts
    float depth_max = 0.0f;
    std::uint32_t after = no_triangle;  ///< at depth_min, hits of triangles with a higher index count too

    [[nodiscard]] bool hits_nothing() const { return !(depth_min < depth_max); }
    [[nodiscard]] float t_of(float depth) const { return depth / depth_per_t; }
};

/// The frame of one ray. Every tracer goes through this function, so that the same ray means the same bits to
/// all.
[[nodiscard]] inline RayFrame ray_frame(const glm::vec3& direction, float t_min, float t_max) {
    const glm::vec3 size{std::fabs(direction.x), std::fabs(direction.y), std::fabs(direction.z)};
    RayFrame frame;
    frame.axes.k = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const float along = direction[frame.axes.k];
    frame.axes.negative = along < 0.0f;
    const float depth_per_t = std::fabs(along);
    if (!(depth_per_t > 0.0f) || !std::isfinite(size.x + size.y + size.z) || !(t_min < t_max)) return frame;

    frame.slope_u = direction[frame.axes.u()] / depth_per_t;
    frame.slope_v = direction[frame.axes.v()] / depth_per_t;
    frame.depth_per_t = depth_per_t;
    frame.depth_min = std::fmax(t_min, 0.0f) * depth_per_t;
    frame.depth_max = t_max * depth_per_t;
    return frame;
}

[[nodiscard]] inline RayFrame ray_frame(const RayBatch& rays, std::size_t ray) {
    return ray_frame(rays.direction_of(ray), rays.t_min[ray], rays.t_max[ray]);
}

/// What all rays of a batch with a common direction share: its depths are no ray's.
[[nodiscard]] inline RayFrame frame_of_parallel(const RayBatch& rays) {
    return ray_frame(*rays.common_direction, 0.0f, std::numeric_limits<float>::infinity());
}

}  // namespace gridreel::traversal
