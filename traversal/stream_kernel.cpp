#include "traversal/stream_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/stream_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "traversal/march_alone-inl.h"
#include "traversal/ray_pairs-inl.h"
#include "traversal/ray_streams-inl.h"

#include <array>
#include <bit>
#include <limits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Remembers the last triangles that rays met, so that one in many cells is tested once.
class StreamMailbox {
public:
    /// Forgetful, never wrong about "met".
    /// @param ray  a number of its own, not 0
    bool meets_first(std::uint64_t ray, std::uint32_t triangle) {
        std::uint64_t& entry = entries_[(triangle ^ (ray * 37)) % entries_.size()];
        const std::uint64_t mark = ray << 32 | triangle;
        const bool first = entry != mark;
        entry = mark;
        return first;
    }

private:
    std::array<std::uint64_t, 256> entries_{};
};

/// Rays of a batch, a few at a time, on their way through the grid.
template <Wanted wanted>
class Streams {
public:
    Streams(const GridScene& scene, const CellDigest& cells, TraceReport& report)
        : scene_(scene), cells_(cells), report_(report) {}

    /// @param next   `next(stream)`: whether there is another ray, begun in that stream
    /// @param store  `store(ray, frame, hit)`
    template <class Next, class Store>
    void run(const Next& next, const Store& store) {
        unsigned alive = 0;
        for (std::uint32_t i = 0; i < stream_count; ++i) alive |= next(i) ? 1u << i : 0u;
        while (alive != 0) {
            const StreamWalk::Stops stops = StreamWalk::walk(places_, alive, std::exchange(fresh_, 0),
                                                             cells_.distances.data(), report_.cells);
            look_into_cells(stops.occupied);
            if (pairs_.size() > 0) meet_pairs();
            for (unsigned ended = stops.ended; ended != 0; ended &= ended - 1) {
                const auto i = static_cast<std::uint32_t>(std::countr_zero(ended));
                if (nesting_[i] > 0) {
                    leave_nested(i);
                    continue;
                }
                store(rays_[i].index, rays_[i].frame, rays_[i].hit);
                if (!next(i)) alive &= ~(1u << i);
            }
        }
    }

    /// @return whether the ray enters the grid
    bool begin(std::uint32_t i, std::size_t index, const glm::vec3& origin, const RayFrame& frame) {
        Ray& ray = rays_[i];
        ray = {.index = index,
               .frame = frame,
               .line = RayLine(origin, frame),
               .hit = {.depth = frame.depth_max}};
        paired_[i] = PairedRay(origin, frame);
        nesting_[i] = 0;
        number_[i] = ++count_;
        update_reach(i);
        return enter(i, 0, 0);
    }

private:
    struct Ray {
        std::size_t index = 0;
        RayFrame frame;
        RayLine line{{}, {}};
        DepthHit hit{};
    };

    /// What is kept of a grid while the stream is in one that is nested in it.
    struct Outer {
        std::array<double, 3> cell, origin, slope, inverse, last;
        double row, layer, first, depth, leave;
    };

    /// Puts the stream where it enters a grid.
    /// @return whether it does
    bool enter(std::uint32_t i, std::size_t level, std::size_t index) {
        const rebuild::UniformGrid& grid = scene_.grid.levels[level].grids[index];
        if (grid.bounds.empty()) return false;
        const RayLine& line = rays_[i].line;
        std::array<double, 3> origin, slope, inverse;
        double enter = line.depth_min, leave = line.depth_max;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int of = static_cast<int>(axis);
            const double per_metre = 1.0 / grid.cell_size[of];
            origin[axis] = (line.origin[of] - double(grid.bounds.min[of])) * per_metre;
            slope[axis] = line.slope[of] * per_metre;
            inverse[axis] = grid.cell_size[of] * line.depth_per_m[of];
            const double a = (0.0 - origin[axis]) * inverse[axis];
            const double b = (double(grid.resolution[of]) - origin[axis]) * inverse[axis];
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        if (!(enter <= leave)) return false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double last = double(grid.resolution[static_cast<int>(axis)] - 1);
            const double at = std::min(std::max(origin[axis] + enter * slope[axis], 0.0), last);
            places_.cell[axis][i] = static_cast<double>(static_cast<std::int64_t>(at));
            places_.origin[axis][i] = origin[axis];
            places_.slope[axis][i] = slope[axis];
            places_.inverse[axis][i] = inverse[axis];
            places_.last[axis][i] = last;
        }
        places_.row[i] = grid.resolution.x;
        places_.layer[i] = double(grid.resolution.x) * double(grid.resolution.y);
        places_.first[i] = static_cast<double>(cells_.distances.first_cell(level) + grid.first_cell);
        places_.depth[i] = enter;
        places_.ahead[i] = 1.0;
        fresh_ |= 1u << i;
        leave_[i] = leave;
        places_.end[i] = std::min(leave, reach_[i]);
        return true;
    }

    void enter_nested(std::uint32_t i, std::size_t index) {
        Outer& outer = outer_[i][nesting_[i]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            outer.cell[axis] = places_.cell[axis][i];
            outer.origin[axis] = places_.origin[axis][i];
            outer.slope[axis] = places_.slope[axis][i];
            outer.inverse[axis] = places_.inverse[axis][i];
            outer.last[axis] = places_.last[axis][i];
        }
        outer.row = places_.row[i];
        outer.layer = places_.layer[i];
        outer.first = places_.first[i];
        outer.depth = places_.depth[i];
        outer.leave = leave_[i];
        if (enter(i, nesting_[i] + 1, index)) ++nesting_[i];
    }

    void leave_nested(std::uint32_t i) {
        const Outer& outer = outer_[i][--nesting_[i]];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            places_.cell[axis][i] = outer.cell[axis];
            places_.origin[axis][i] = outer.origin[axis];
            places_.slope[axis][i] = outer.slope[axis];
            places_.inverse[axis][i] = outer.inverse[axis];
            places_.last[axis][i] = outer.last[axis];
        }
        places_.row[i] = outer.row;
        places_.layer[i] = outer.layer;
        places_.first[i] = outer.first;
        places_.depth[i] = outer.depth;
        places_.ahead[i] = 1.0;
        leave_[i] = outer.leave;
        places_.end[i] = std::min(leave_[i], reach_[i]);
    }

    /// What is to be read of the lists at which streams have stopped.
    struct List {
        const std::uint32_t* references;
        const ReferenceBox* boxes;
        std::uint32_t left;
        std::uint32_t stream;
    };

    /// Pairs the streams with the triangles of their cells. Each step is done for all streams before the
    /// next: so they wait for memory together, and hardly a branch depends on what a cell holds.
    void look_into_cells(unsigned streams) {
        if (streams == 0) return;
        std::size_t count = 0;
        const unsigned stopped = streams;
        for (; streams != 0; streams &= streams - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(streams));
            const auto cell =
                static_cast<std::size_t>(places_.cell[0][i] + places_.cell[1][i] * places_.row[i] +
                                         places_.cell[2][i] * places_.layer[i] + places_.first[i]) -
                cells_.distances.first_cell(nesting_[i]);
            cell_begin_[count] = scene_.grid.levels[nesting_[i]].cell_begin.data() + cell;
            hwy::Prefetch(cell_begin_[count]);
            lists_[count++].stream = i;
        }
        if (cells_.boxes != nullptr) StreamWalk::cut(places_, reach_, stopped, pieces_);
        for (std::size_t k = 0; k < count; ++k) {
            List& list = lists_[k];
            const std::size_t depth = nesting_[list.stream];
            const std::uint32_t begin = cell_begin_[k][0];
            list.left = cell_begin_[k][1] - begin;
            list.references = scene_.grid.levels[depth].references.data() + begin;
            hwy::Prefetch(list.references);
            list.boxes = nullptr;
            if (cells_.boxes != nullptr) {
                list.boxes = cells_.boxes->level(depth) + begin;
                hwy::Prefetch(list.boxes);
            }
        }
        // Cells of triangles, and cells that are grids.
        std::size_t leaves = 0, nested_count = 0;
        std::uint32_t nested[stream_count];
        for (std::size_t k = 0; k < count; ++k) {
            const List list = lists_[k];
            const bool is_nested = (list.references[0] & rebuild::nested_mark) != 0;
            nested[nested_count] = list.stream;
            grids_[nested_count] = list.references[0] & ~rebuild::nested_mark;
            nested_count += is_nested ? 1 : 0;
            lists_[leaves] = list;
            leaves += is_nested ? 0 : 1;
        }
        read_lists(leaves);
        for (std::size_t k = 0; k < nested_count; ++k) enter_nested(nested[k], grids_[k]);
    }

    /// Pairs streams with the triangles of the first `count` lists.
    void read_lists(std::size_t count) {
        std::size_t k = 0;
        List list = lists_[0];
        while (k < count) {
            if (!pairs_.has_room(boxes_at_a_time)) meet_pairs();
            unsigned near = list.boxes == nullptr ? (1u << boxes_at_a_time) - 1
                                                  : near_boxes(list.boxes, pieces_[list.stream].data());
            near &= (1u << std::min<std::uint32_t>(list.left, boxes_at_a_time)) - 1;
            pairs_.add(list.references, near, list.stream);
            if (list.left > boxes_at_a_time) {
                list.references += boxes_at_a_time;
                list.boxes += list.boxes == nullptr ? 0 : boxes_at_a_time;
                list.left -= std::uint32_t{boxes_at_a_time};
            } else {
                list = lists_[++k];
            }
        }
    }

    void meet_pairs() {
        pairs_.keep([&](std::uint32_t i, std::uint32_t triangle) {
            return mailbox_.meets_first(number_[i], triangle);
        });
        if (pairs_.size() == 0) return;
        report_.triangle_tests += pairs_.size();
        pairs_.meet_all(scene_.triangles, paired_.data(), best_.data(),
                        [&](std::uint32_t i, std::uint32_t triangle, float depth) {
                            const RayFrame& frame = rays_[i].frame;
                            DepthHit& hit = rays_[i].hit;
                            const bool begun = depth > frame.depth_min ||
                                               (depth == frame.depth_min && triangle > frame.after);
                            if (!(begun && depth < frame.depth_max)) return;
                            if (depth < hit.depth || (depth == hit.depth && triangle < hit.triangle)) {
                                hit = {.depth = depth, .triangle = triangle};
                                update_reach(i);
                                places_.end[i] = std::min(places_.end[i], reach_[i]);
                            }
                        });
    }

    void update_reach(std::uint32_t i) {
        const DepthHit& hit = rays_[i].hit;
        best_[i] = hit.depth;
        // Any hit is enough.
        reach_[i] = wanted == Wanted::any && hit.triangle != no_triangle
                        ? 0.0
                        : double(hit.depth) * (1.0 + depth_error);
    }

    const GridScene& scene_;
    const CellDigest& cells_;
    TraceReport& report_;
    std::uint64_t count_ = 0;
    unsigned fresh_ = 0;  ///< streams that enter a grid
    StreamPlaces places_{};
    alignas(64) PerStream<double> reach_{};  ///< cells that begin behind it hold nothing nearer
    PerStream<double> leave_{};              ///< depth at which the stream leaves its grid, or counts no more
    PerStream<std::size_t> nesting_{};
    PerStream<const std::uint32_t*> cell_begin_{};
    std::array<List, stream_count + 1> lists_{};
    PerStream<std::uint32_t> grids_{};
    PerStream<std::uint64_t> number_{};
    PerStream<float> best_{};
    alignas(64) PerStream<std::array<std::uint64_t, piece_count>> pieces_{};
    PerStream<Ray> rays_{};
    PerStream<PairedRay> paired_{};
    PerStream<std::array<Outer, rebuild::deepest_nesting>> outer_{};
    StreamMailbox mailbox_;
    RayPairs pairs_;
};

template <Wanted wanted, class Store>
TraceReport trace(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                  const ResumedRays& resumed, Unanswered left, std::size_t begin, std::size_t end,
                  const Store& store) {
    TraceReport report{.rays = end - begin};
    Packet packet;
    Candidates candidates;
    const PacketSource source(rays, resumed, nullptr);
    Streams<wanted> streams(scene, cells, report);
    std::size_t i = begin;
    streams.run(
        [&](std::uint32_t stream) {
            for (; i < end; ++i) {
                if (!left.empty() && left[i] != undecided) continue;
                const RayFrame ray = resumed.frame(rays, i);
                const glm::vec3 origin = rays.origin_of(i);
                const bool can_hit =
                    !ray.hits_nothing() && !scene.grid.empty() && rebuild::is_traceable(origin);
                if (can_hit && is_far(scene.grid, origin)) {
                    store(i, ray,
                          march_alone<wanted>(scene, source, static_cast<std::uint32_t>(i), ray.axes, packet,
                                              candidates, report));
                } else if (can_hit && streams.begin(stream, i, origin, ray)) {
                    ++i;
                    return true;
                } else {
                    store(i, ray, DepthHit{});
                }
            }
            return false;
        },
        store);
    return report;
}

TraceReport closest_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                               const ResumedRays& resumed, Unanswered left, std::size_t begin,
                               std::size_t end, HitBatch& hits) {
    return trace<Wanted::closest>(scene, cells, rays, resumed, left, begin, end,
                                  [&](std::size_t i, const RayFrame& ray, const DepthHit& hit) {
                                      const bool missed = hit.triangle == no_triangle;
                                      hits.t[i] = missed ? std::numeric_limits<float>::infinity()
                                                         : ray.t_of(hit.depth);
                                      hits.triangle[i] = hit.triangle;
                                  });
}

TraceReport any_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                           const ResumedRays& resumed, Unanswered left, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded) {
    return trace<Wanted::any>(scene, cells, rays, resumed, left, begin, end,
                              [&](std::size_t i, const RayFrame&, const DepthHit& hit) {
                                  occluded[i] = hit.triangle != no_triangle;
                              });
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(closest_in_streams);
HWY_EXPORT(any_in_streams);

TraceReport closest_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                               const ResumedRays& resumed, Unanswered left, std::size_t begin,
                               std::size_t end, HitBatch& hits) {
    return HWY_DYNAMIC_DISPATCH(closest_in_streams)(scene, cells, rays, resumed, left, begin, end, hits);
}

TraceReport any_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                           const ResumedRays& resumed, Unanswered left, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded) {
    return HWY_DYNAMIC_DISPATCH(any_in_streams)(scene, cells, rays, resumed, left, begin, end, occluded);
}

}  // namespace gridreel::traversal
#endif
