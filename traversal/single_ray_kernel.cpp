#include "traversal/single_ray_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/single_ray_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/lane_ray-inl.h"
#include "traversal/naive_kernel.h"
#include "traversal/packet_load-inl.h"
#include "traversal/packet_march-inl.h"
#include "traversal/ray_walk.h"

#include <array>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

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

/// One ray on its way through the grid.
template <Wanted wanted>
class SingleWalk {
public:
    SingleWalk(const GridScene& scene, const glm::vec3& origin, const RayFrame& ray, RayMailbox& mailbox,
               TraceReport& report)
        : scene_(scene),
          origin_(origin),
          ray_(ray),
          lane_ray_(origin, ray),
          mailbox_(mailbox),
          report_(report),
          hit_{.depth = ray.depth_max} {
        mailbox_.next_ray();
    }

    DepthHit run() {
        (void)walk(0, 0);
        return hit_;
    }

private:
    /// @return whether nothing more is wanted
    bool walk(std::size_t depth, std::size_t index) {
        const rebuild::GridLevel& level = scene_.grid.levels[depth];
        for (RayWalk at(level.grids[index], origin_, ray_); at.inside(); at.advance()) {
            ++report_.cells;
            const std::uint32_t begin = level.cell_begin[at.cell()], end = level.cell_begin[at.cell() + 1];
            if (begin < end && (level.references[begin] & rebuild::nested_mark) != 0) {
                if (walk(depth + 1, level.references[begin] & ~rebuild::nested_mark)) return true;
            } else if (meet(level.references.data() + begin, end - begin)) {
                return true;
            }
            // A hit beyond this cell is kept, but a nearer one may wait in the cells between.
            if (double(hit_.depth) * (1.0 + depth_error) <= at.exit_depth()) break;
        }
        return false;
    }

    /// The triangles of one cell.
    /// @return whether nothing more is wanted
    bool meet(const std::uint32_t* triangles, std::size_t count) {
        std::uint32_t waiting[LaneRay::width];
        std::size_t waiting_count = 0;
        for (std::size_t i = 0; i < count; ++i) {
            if (!mailbox_.first_meeting(triangles[i])) continue;
            waiting[waiting_count++] = triangles[i];
            if (waiting_count < LaneRay::width) continue;
            if (meet_waiting(waiting, waiting_count)) return true;
            waiting_count = 0;
        }
        return waiting_count > 0 && meet_waiting(waiting, waiting_count);
    }

    bool meet_waiting(const std::uint32_t* triangles, std::size_t count) {
        report_.triangle_tests += count;
        HWY_ALIGN float depths[LaneRay::width];
        lane_ray_.meet_triangles(scene_.triangles, triangles, count, hit_.depth, depths);
        for (std::size_t i = 0; i < count; ++i) {
            const float depth = depths[i];
            const bool begun =
                depth > ray_.depth_min || (depth == ray_.depth_min && triangles[i] > ray_.after);
            if (!(begun && depth < ray_.depth_max)) continue;
            if (depth < hit_.depth || (depth == hit_.depth && triangles[i] < hit_.triangle)) {
                hit_ = {.depth = depth, .triangle = triangles[i]};
            }
            if (wanted == Wanted::any) return true;
        }
        return false;
    }

    const GridScene& scene_;
    const glm::vec3 origin_;
    const RayFrame& ray_;
    LaneRay lane_ray_;
    RayMailbox& mailbox_;
    TraceReport& report_;
    DepthHit hit_;
};

/// The ray as a packet of its own, whose width makes up for the rounding of corners as far away as its are.
template <Wanted wanted>
DepthHit march_alone(const GridScene& scene, const PacketSource& source, std::uint32_t ray, Axes axes,
                     Packet& packet, Candidates& candidates, TraceReport& report) {
    load_chosen(source, axes, {&ray, 1}, packet);
    March<wanted>(scene, packet, candidates, report).run();
    const bool hit = packet.depth[0] < packet.depth_max[0];
    return {.depth = packet.depth[0], .triangle = hit ? packet.triangle[0] : no_triangle};
}

template <Wanted wanted, class Store>
TraceReport trace(const GridScene& scene, const RayBatch& rays, const ResumedRays& resumed, std::size_t begin,
                  std::size_t end, const Store& store) {
    TraceReport report{.rays = end - begin};
    RayMailbox mailbox;
    Packet packet;
    Candidates candidates;
    const PacketSource source(rays, resumed, nullptr);
    for (std::size_t i = begin; i < end; ++i) {
        const RayFrame ray = resumed.frame(rays, i);
        const glm::vec3 origin = rays.origin_of(i);
        if (ray.hits_nothing() || scene.grid.empty() || !rebuild::is_traceable(origin)) {
            store(i, ray, DepthHit{});
            continue;
        }
        const rebuild::UniformGrid& top = scene.grid.top();
        const bool far = farthest_offset(top.bounds, origin) * 0x1p-23 > top.least_slack;
        store(i, ray,
              far ? march_alone<wanted>(scene, source, static_cast<std::uint32_t>(i), ray.axes, packet,
                                        candidates, report)
                  : SingleWalk<wanted>(scene, origin, ray, mailbox, report).run());
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
