#include "traversal/single_ray_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/single_ray_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/naive_kernel.h"
#include "traversal/ray_walk.h"
#include "traversal/triangle-inl.h"

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

/// One ray in the form the lane kernel wants it, one lane wide.
class LaneRay {
public:
    LaneRay(const glm::vec3& origin, const RayFrame& ray)
        : origin_(origin), ray_(ray), axes_{ray.axes.k, ray.axes.u(), ray.axes.v()} {}

    /// Depth of the hit, or NaN.
    [[nodiscard]] float meet_triangle(const GridScene& scene, std::uint32_t triangle) const {
        const FramedPoint a = corner(scene, triangle, 0), b = corner(scene, triangle, 1),
                          c = corner(scene, triangle, 2);
        const auto edges =
            edge_functions(lane, in_lane(a), in_lane(b), in_lane(c), hn::Set(lane, ray_.axes.sign()));
        const auto met =
            meet(lane, edges, hn::Set(lane, ray_.slope_u), hn::Set(lane, ray_.slope_v), [&](std::size_t) {
                return meet_in_double(a, b, c, ray_.axes.sign(), ray_.slope_u, ray_.slope_v);
            });
        return hn::GetLane(hn::IfThenElse(met.inside, met.depth, hn::NaN(lane)));
    }

private:
    static constexpr hn::CappedTag<float, 1> lane{};
    using V = hn::Vec<hn::CappedTag<float, 1>>;

    [[nodiscard]] FramedPoint corner(const GridScene& scene, std::uint32_t triangle, int which) const {
        const glm::vec3& p = scene.corner(triangle, which);
        return {.k = p[axes_[0]] - origin_[axes_[0]],
                .u = p[axes_[1]] - origin_[axes_[1]],
                .v = p[axes_[2]] - origin_[axes_[2]]};
    }

    [[nodiscard]] static Vec3<V> in_lane(const FramedPoint& p) {
        return {hn::Set(lane, p.k), hn::Set(lane, p.u), hn::Set(lane, p.v)};
    }

    glm::vec3 origin_;
    RayFrame ray_;
    std::array<int, 3> axes_;
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
            const float depth = lane_ray.meet_triangle(scene, triangle);
            if (!(depth > ray.depth_min && depth < ray.depth_max)) continue;
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
TraceReport trace(const GridScene& scene, const RayBatch& rays, std::size_t begin, std::size_t end,
                  const Store& store) {
    TraceReport report{.rays = end - begin};
    RayMailbox mailbox;
    for (std::size_t i = begin; i < end; ++i) {
        const RayFrame ray = ray_frame(rays, i);
        store(i, ray, walk<wanted>(scene, rays.origin_of(i), ray, mailbox, report));
    }
    return report;
}

TraceReport closest_one_by_one(const GridScene& scene, const RayBatch& rays, std::size_t begin,
                               std::size_t end, HitBatch& hits) {
    return trace<Wanted::closest>(
        scene, rays, begin, end, [&](std::size_t i, const RayFrame& ray, const DepthHit& hit) {
            const bool missed = hit.triangle == no_triangle;
            hits.t[i] = missed ? std::numeric_limits<float>::infinity() : ray.t_of(hit.depth);
            hits.triangle[i] = hit.triangle;
        });
}

TraceReport any_one_by_one(const GridScene& scene, const RayBatch& rays, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded) {
    return trace<Wanted::any>(scene, rays, begin, end,
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

TraceReport closest_one_by_one(const GridScene& scene, const RayBatch& rays, std::size_t begin,
                               std::size_t end, HitBatch& hits) {
    return HWY_DYNAMIC_DISPATCH(closest_one_by_one)(scene, rays, begin, end, hits);
}

TraceReport any_one_by_one(const GridScene& scene, const RayBatch& rays, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded) {
    return HWY_DYNAMIC_DISPATCH(any_one_by_one)(scene, rays, begin, end, occluded);
}

}  // namespace gridreel::traversal
#endif
