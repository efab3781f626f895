// A ray from so far away that it goes through the grid like a packet. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_MARCH_ALONE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_MARCH_ALONE_INL_H_
#undef GRIDREEL_TRAVERSAL_MARCH_ALONE_INL_H_
#else
#define GRIDREEL_TRAVERSAL_MARCH_ALONE_INL_H_
#endif

#include "traversal/depth_hit.h"
#include "traversal/packet_load-inl.h"
#include "traversal/packet_march-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Whether corners, rounded relative to a ray's origin, may stand farther beside their place than grids
/// allow.
[[nodiscard]] inline bool is_far(const rebuild::Grid& grid, const glm::vec3& origin) {
    return corner_error(grid.top().bounds, origin) > grid.top().least_slack;
}

/// Whether anything can be hit by the ray, or else it goes nowhere.
[[nodiscard]] inline bool may_hit(const rebuild::Grid& grid, const glm::vec3& origin, const RayFrame& ray) {
    return !ray.hits_nothing() && !grid.empty() && rebuild::is_traceable(origin);
}

/// The ray as a packet of its own, whose width makes up for the rounding of corners as far away as its are.
template <Wanted wanted>
DepthHit march_alone(const GridScene& scene, const PacketSource& source, std::uint32_t ray, Axes axes,
                     Packet& packet, Candidates& candidates, TraceReport& report) {
    load_chosen(source, axes, {&ray, 1}, packet);
    March<wanted>(scene, packet, candidates, report).run();
    const bool hit = packet.depth[0] < packet.depth_max[0];
    return {.depth = packet.depth[0], .triangle = hit ? packet.triangle[0] : no_triangle};
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
