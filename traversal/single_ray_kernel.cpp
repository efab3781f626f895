#include "traversal/single_ray_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/single_ray_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/cell_pieces-inl.h"
#include "traversal/depth_hit.h"
#include "traversal/lane_ray-inl.h"
#include "traversal/lane_walk-inl.h"
#include "traversal/march_alone-inl.h"
#include "traversal/ray_places.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Remembers the last triangles that the current ray met, so that one in many cells is tested once.
class RayMailbox {
public:
    void next_ray() { ++ray_; }

    /// Writes those of `count` triangles that this ray has not met yet, and whatever it likes behind them;
    /// forgetful, never wrong about "met".
    /// @param unmet  room for `count`
    /// @return how many they are
    std::size_t first_meetings(const std::uint32_t* triangles, std::size_t count, std::uint32_t* unmet) {
        std::size_t unmet_count = 0;
        for (std::size_t i = 0; i < count; ++i) {
            std::uint64_t& entry = entries_[triangles[i] % entries_.size()];
            const std::uint64_t mark = ray_ << 32 | triangles[i];
            unmet[unmet_count] = triangles[i];
            unmet_count += entry != mark ? 1 : 0;
            entry = mark;
        }
        return unmet_count;
    }

private:
    std::uint64_t ray_ = 0;  // 0 is never a ray: `next_ray` comes first
    std::array<std::uint64_t, 256> entries_{};
};

/// One ray on its way through the grid.
template <Wanted wanted>
class SingleWalk {
public:
    SingleWalk(const GridScene& scene, const CellDigest& cells, const glm::vec3& origin, const RayFrame& ray,
               RayMailbox& mailbox, TraceReport& report)
        : scene_(scene),
          cells_(cells),
          line_(origin, ray),
          ray_(ray),
          lane_ray_(origin, ray),
          mailbox_(mailbox),
          report_(report),
          hit_{.depth = ray.depth_max} {
        mailbox_.next_ray();
        update_reach();
    }

    DepthHit run() {
        if (!walk(0, 0)) (void)meet_waiting();
        return hit_;
    }

private:
    /// @return whether nothing more is wanted
    bool walk(std::size_t depth, std::size_t index) {
        const rebuild::GridLevel& level = scene_.grid.levels[depth];
        const std::uint8_t* const steps = cells_.distances.data() + cells_.distances.first_cell(depth);
        const WalkStart start(level.grids[index], line_);
        if (!start.inside) return false;
        const RayPlaces places(level.grids[index], line_);
        double entry = start.enter_depth;
        for (LaneWalk at(start); at.inside(); at.advance()) {
            const double exit = at.exit_depth();
            ++report_.cells;
            if (steps[at.cell()] == 0) {
                const std::uint32_t begin = level.cell_begin[at.cell()];
                const std::uint32_t end = level.cell_begin[at.cell() + 1];
                if ((level.references[begin] & rebuild::nested_mark) != 0) {
                    if (walk(depth + 1, level.references[begin] & ~rebuild::nested_mark)) return true;
                } else if (cells_.boxes == nullptr) {
                    if (take(level.references.data() + begin, end - begin)) return true;
                } else {
                    cut(places, at.steps_left(), entry, std::max(entry, std::min(exit, reach_)));
                    if (take_near(level.references.data(), cells_.boxes->level(depth), begin, end)) {
                        return true;
                    }
                }
            }
            // A hit beyond this cell is kept, but a nearer one may wait in the cells between.
            if (reach_ <= exit) break;
            entry = std::max(entry, exit);  // a plane that the ray lies in is crossed nowhere
        }
        return false;
    }

    /// Lets the triangles of one cell wait, and tests those that fill a pass.
    /// @return whether nothing more is wanted
    bool take(const std::uint32_t* triangles, std::size_t count) {
        while (count > 0) {
            const std::size_t some = std::min(count, capacity - waiting_count_);
            waiting_count_ += mailbox_.first_meetings(triangles, some, waiting_ + waiting_count_);
            triangles += some;
            count -= some;
            if (waiting_count_ >= worth_testing && meet_waiting()) return true;
        }
        return false;
    }

    /// Cuts the way through a cell in pieces.
    void cut(const RayPlaces& places, std::uint64_t steps_left, double from, double to) {
        const hn::CappedTag<float, 1> d;
        hn::Vec<decltype(d)> begin[3], end[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            begin[axis] = hn::Set(d, places.place(axis, steps_left, from));
            end[axis] = hn::Set(d, places.place(axis, steps_left, to));
        }
        const auto halves = cut_in_pieces(d, begin, end);
        for (std::size_t i = 0; i < piece_count; ++i) {
            pieces_[i] = hn::GetLane(halves.first[i]) | std::uint64_t{hn::GetLane(halves.last[i])} << 32;
        }
    }

    /// As `take`, for those of references [begin, end) whose boxes the pieces come near.
    bool take_near(const std::uint32_t* references, const ReferenceBox* boxes, std::uint32_t begin,
                   std::uint32_t end) {
        for (std::uint32_t first = begin; first < end; first += boxes_at_a_time) {
            unsigned near = near_boxes(boxes + first, pieces_);
            if (end - first < boxes_at_a_time) near &= (1u << (end - first)) - 1;
            std::uint32_t triangles[boxes_at_a_time];
            std::size_t count = 0;
            for (; near != 0; near &= near - 1) {
                triangles[count++] = references[first + static_cast<std::uint32_t>(std::countr_zero(near))];
            }
            if (take(triangles, count)) return true;
        }
        return false;
    }

    /// @return whether nothing more is wanted
    bool meet_waiting() {
        report_.triangle_tests += waiting_count_;
        const std::size_t count = std::exchange(waiting_count_, 0);
        for (std::size_t first = 0; first < count; first += LaneRay::width) {
            if (meet(waiting_ + first, std::min(count - first, LaneRay::width))) return true;
        }
        return false;
    }

    bool meet(const std::uint32_t* triangles, std::size_t count) {
        HWY_ALIGN float depths[LaneRay::width];
        unsigned met = lane_ray_.meet_triangles(scene_.triangles, triangles, count, hit_.depth, depths);
        for (; HWY_UNLIKELY(met != 0); met &= met - 1) {
            const int i = std::countr_zero(met);
            const DepthHit met_here{.depth = depths[i], .triangle = triangles[i]};
            if (!counts(ray_, met_here)) continue;
            if (comes_before(met_here, hit_)) {
                hit_ = met_here;
                update_reach();
            }
            if (wanted == Wanted::any) return true;
        }
        return false;
    }

    void update_reach() { reach_ = double(hit_.depth) * (1.0 + depth_error); }

    static constexpr std::size_t capacity = 64;
    static constexpr std::size_t worth_testing = 4;

    const GridScene& scene_;
    const CellDigest& cells_;
    const RayLine line_;
    const RayFrame& ray_;
    LaneRay lane_ray_;
    RayMailbox& mailbox_;
    TraceReport& report_;
    DepthHit hit_;
    double reach_ = 0.0;  ///< cells that begin behind it hold nothing nearer
    std::size_t waiting_count_ = 0;
    std::uint32_t waiting_[capacity];
    std::uint64_t pieces_[piece_count];
};

template <Wanted wanted, class Answers>
TraceReport trace(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                  const ResumedRays& resumed, std::size_t begin, std::size_t end, Answers& answers) {
    TraceReport report{.rays = end - begin};
    RayMailbox mailbox;
    Packet packet;
    Candidates candidates;
    const PacketSource source(rays, resumed, nullptr);
    for (std::size_t i = begin; i < end; ++i) {
        const RayFrame ray = resumed.frame(rays, i);
        const glm::vec3 origin = rays.origin_of(i);
        if (!may_hit(scene.grid, origin, ray)) {
            store(ray, DepthHit{}, i, answers);
            continue;
        }
        store(ray,
              is_far(scene.grid, origin)
                  ? march_alone<wanted>(scene, source, static_cast<std::uint32_t>(i), ray.axes, packet,
                                        candidates, report)
                  : SingleWalk<wanted>(scene, cells, origin, ray, mailbox, report).run(),
              i, answers);
    }
    return report;
}

TraceReport closest_one_by_one(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                               const ResumedRays& resumed, std::size_t begin, std::size_t end,
                               HitBatch& hits) {
    return trace<Wanted::closest>(scene, cells, rays, resumed, begin, end, hits);
}

TraceReport any_one_by_one(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                           const ResumedRays& resumed, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded) {
    return trace<Wanted::any>(scene, cells, rays, resumed, begin, end, occluded);
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(closest_one_by_one);
HWY_EXPORT(any_one_by_one);

TraceReport closest_one_by_one(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                               const ResumedRays& resumed, std::size_t begin, std::size_t end,
                               HitBatch& hits) {
    return HWY_DYNAMIC_DISPATCH(closest_one_by_one)(scene, cells, rays, resumed, begin, end, hits);
}

TraceReport any_one_by_one(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                           const ResumedRays& resumed, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded) {
    return HWY_DYNAMIC_DISPATCH(any_one_by_one)(scene, cells, rays, resumed, begin, end, occluded);
}

}  // namespace gridreel::traversal
#endif
