#include "traversal/single_ray_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/single_ray_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/lane_ray-inl.h"
#include "traversal/naive_kernel.h"
#include "traversal/ray_walk.h"

#include <array>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

enum class Wanted { closest, any };

/// Remembers the last triangles that the current ray met, so that one in many cells is tested once.
class RayMailbox {
public:
    void next_ray() { ++ray_; }

    /// Whether this ray has not met `triangle` yet; forgetful, never wrong about "met".
    bool first_meeting(std::uint32_t triangle) {
        std::uint64_t& entry = entries_[triangle % entries_.size()];
        const std::uint64_t mark = ray_ << 32 | triangle;
        if (entry == mark) return false;
        entry = mark;
        return true;
    }

private:
    std::uint64_t ray_ = 0;  // 0 is never a ray: `next_ray` comes first
    std::array<std::uint64_t, 256> entries_{};
};

template <Wanted wanted>
DepthHit walk(const GridScene& scene, const glm::vec3& origin, const RayFrame& ray, RayMailbox& mailbox,
              TraceReport& report) {
    const LaneRay lane_ray(origin, ray);
    DepthHit hit{.depth = ray.depth_max};
    mailbox.next_ray();
    for (RayWalk at(scene.grid, origin, ray); at.inside(); at.advance()) {
        ++report.cells;
        const std::uint32_t end = scene.grid.cell_begin[at.cell() + 1];
        for (std::uint32_t i = scene.grid.cell_begin[at.cell()]; i < end; ++i) {
            const std::uint32_t triangle = scene.grid.references[i];
            if (!mailbox.first_meeting(triangle)) continue;
            ++report.triangle_tests;
            const float depth = lane_ray.meet_triangle(scene.triangles, triangle);
            const bool begun = depth > ray.depth_min || (depth == ray.depth_min && triangle > ray.after);
            if (!(begun && depth < ray.depth_max)) continue;
            if (depth < hit.depth || (depth == hit.depth && triangle < hit.triangle)) {
                hit = {.depth = depth, .triangle = triangle};
            }
            if (wanted == Wanted::any) return hit;
        }
        // A hit beyond this cell is kept, but a nearer one may wait in the cells between.
        if (double(hit.depth) * (1.0 + depth_error) <= at.exit_depth()) break;
    }
    return hit;
}

template <Wanted wanted, class Store>
TraceReport trace(const GridScene& scene, const RayBatch& rays, const ResumedRays& resumed, std::size_t begin,
                  std::size_t end, const Store& store) {
    TraceReport report{.rays = end - begin};
    RayMailbox mailbox;
    for (std::size_t i = begin; i < end; ++i) {
        const RayFrame ray = resumed.frame(rays, i);
        store(i, ray, walk<wanted>(scene, rays.origin_of(i), ray, mailbox, report));
    }
    return report;
}

TraceReport closest_one_by_one(const GridScene& scene, const RayBatch& rays, const ResumedRays& resumed,
                               std::size_t begin, std::size_t end, HitBatch& hits) {
    return trace<Wanted::closest>(
        scene, rays, resumed, begin, end, [&](std::size_t i, const RayFrame& ray, const DepthHit& hit) {
            const bool missed = hit.triangle == no_triangle;
            hits.t[i] = missed ? std::numeric_limits<float>::infinity() : ray.t_of(hit.depth);
            hits.triangle[i] = hit.triangle;
        });
}

TraceReport any_one_by_one(const GridScene& scene, const RayBatch& rays, const ResumedRays& resumed,
                           std::size_t begin, std::size_t end, OcclusionBatch& occluded) {
    return trace<Wanted::any>(scene, rays, resumed, begin, end,
                              [&](std::size_t i, const RayFrame&, const DepthHit& hit) {
                                  occluded[i] = hit.triangle != no_triangle;
                              });
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(closest_one_by_one);
HWY_EXPORT(any_one_by_one);

TraceReport closest_one_by_one(const GridScene& scene, const RayBatch& rays, const ResumedRays& resumed,
                               std::size_t begin, std::size_t end, HitBatch& hits) {
    return HWY_DYNAMIC_DISPATCH(closest_one_by_one)(scene, rays, resumed, begin, end, hits);
}

TraceReport any_one_by_one(const GridScene& scene, const RayBatch& rays, const ResumedRays& resumed,
                           std::size_t begin, std::size_t end, OcclusionBatch& occluded) {
    return HWY_DYNAMIC_DISPATCH(any_one_by_one)(scene, rays, resumed, begin, end, occluded);
}

}  // namespace gridreel::traversal
#endif
