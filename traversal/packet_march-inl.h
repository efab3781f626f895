// The walk of one packet through the grid, slice by slice. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_
#undef GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_
#endif

#include "traversal/candidates.h"
#include "traversal/cell_lists-inl.h"
#include "traversal/grid_scene.h"
#include "traversal/loose_intersect-inl.h"
#include "traversal/packet_intersect-inl.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Triangles that must wait before they are worth a pass of 16 lanes.
constexpr std::size_t worth_a_pass = 8;
/// A packet that covers more cells than this per active block in one slice goes on as two.
constexpr std::int64_t cells_per_block_limit = 16;

/// A block of loose rays that covers more is given up: they do not run the same way.
constexpr std::int64_t cells_of_loose_block_limit = 128;

/// What things take, in cycles, roughly: counted, not timed, so that a limit means the same every time.
constexpr std::uint64_t work_of_cell = 10, work_of_candidate = 35, work_of_test = 2, work_of_loose_test = 8;
constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

/// The grid as the packet sees it: one axis across, in depth and offsets from the packet's origin.
struct Across {
    double low, high;  // the box, relative to the origin
    double cells_per_metre;
    int last;            // cell
    std::size_t stride;  // in cells

    [[nodiscard]] int cell(double offset) const {
        return static_cast<int>(std::clamp(std::floor((offset - low) * cells_per_metre), 0.0, double(last)));
    }
};

/// One grid as the packet sees it.
struct Stage {
    const rebuild::GridLevel& level;
    std::size_t depth;  // of nesting
    std::size_t first_cell;
    Across u, v;
    int slices;
    double slice_depth, first_plane;  // the plane's depth may be negative
    std::size_t slice_stride;
};

template <Wanted wanted, Bundle bundle = Bundle::pencil>
class March {
    using Frustum = FrustumOf<bundle>;

public:
    March(const GridScene& scene, Packet& packet, Candidates& candidates, TraceReport& report)
        : scene_(scene), packet_(packet), candidates_(candidates), report_(report) {}

    /// Traces all blocks through the whole grid, as long as that takes no more work than `limit`.
    /// @return a bit for each block that was given up
    BlockMask run(std::uint64_t limit = no_limit) {
        work_ = 0;
        work_limit_ = limit;
        given_up_ = 0;
        const Stage top = stage(0, 0);
        // Corners are rounded when they are taken relative to the origin: far away they stand beside their
        // cells.
        corner_error_ = bundle != Bundle::pencil ? double(packet_.margin)
                                                 : corner_error(scene_.grid.top().bounds, packet_.origin);
        candidates_.clear(scene_.packets.mailbox);
        walk_alone(top, packet_.all_blocks(), 0);
        return given_up_;
    }

private:
    [[nodiscard]] Stage stage(std::size_t depth, std::size_t index) const {
        const rebuild::GridLevel& level = scene_.grid.levels[depth];
        const rebuild::UniformGrid& grid = level.grids[index];
        const std::array<std::size_t, 3> stride{
            1, std::size_t(grid.resolution.x),
            std::size_t(grid.resolution.x) * std::size_t(grid.resolution.y)};
        const auto across = [&](int axis) {
            const auto i = static_cast<std::size_t>(axis);
            return Across{.low = double(grid.bounds.min[axis]) - double(packet_.origin[axis]),
                          .high = double(grid.bounds.max[axis]) - double(packet_.origin[axis]),
                          .cells_per_metre = 1.0 / grid.cell_size[axis],
                          .last = grid.resolution[axis] - 1,
                          .stride = stride[i]};
        };
        const int k = packet_.axes.k;
        const Across along = across(k);
        return {.level = level,
                .depth = depth,
                .first_cell = grid.first_cell,
                .u = across(packet_.axes.u()),
                .v = across(packet_.axes.v()),
                .slices = grid.resolution[k],
                .slice_depth = grid.cell_size[k],
                .first_plane = packet_.axes.negative ? -along.high : along.low,
                .slice_stride = along.stride};
    }

    /// Walks the blocks from `slice` on, and tests all that they collect.
    void walk_alone(const Stage& at, BlockMask active, int slice) {
        Frustum frustum = frustum_of<bundle>(packet_, active);
        walk(at, active, frustum, slice);
        flush(active, frustum);
    }

    /// Walks the active blocks through one grid; what they collected last may still wait at the end.
    void walk(const Stage& at, BlockMask& active, Frustum& frustum, int slice) {
        slice = std::max(slice, first_slice(at, frustum));
        bool entered = false;
        int occupied_until = 0;
        for (; slice < at.slices && active != 0; ++slice) {
            if (at.depth == 0 && scene_.macrocells != nullptr && slice >= occupied_until) {
                slice = first_occupied(at, frustum, slice, occupied_until);
                if (slice >= at.slices) break;
            }
            // A hit in an earlier slice is final, one in this or a later slice is not yet.
            const double from = std::max(double(frustum.near_depth), at.first_plane + slice * at.slice_depth);
            const double to = at.first_plane + (slice + 1) * at.slice_depth;
            if (from > double(frustum.far_depth) * (1.0 + depth_error)) break;

            const auto [u, v] = span_between(frustum, from, to);
            if (u.high < at.u.low || u.low > at.u.high || v.high < at.v.low || v.low > at.v.high) {
                if (entered) break;  // a frustum and a box are convex: it does not come back
                continue;
            }
            entered = true;

            const Cells cells{.u0 = at.u.cell(u.low),
                              .u1 = at.u.cell(u.high),
                              .v0 = at.v.cell(v.low),
                              .v1 = at.v.cell(v.high)};
            const int blocks = std::popcount(active);
            if (bundle == Bundle::loose && blocks == 1 && cells.count() > cells_of_loose_block_limit) {
                given_up_ |= std::exchange(active, 0);
                return;
            }
            if (blocks > 1 && cells.count() > cells_per_block_limit * blocks) {
                split(at, active, frustum, slice);
                return;
            }
            report_.cells += static_cast<std::uint64_t>(cells.count());
            if (!afford(static_cast<std::uint64_t>(cells.count()) * work_of_cell, active)) return;
            collect(at, slice, cells, active, frustum);
            add_candidates(active, frustum);
            if (candidates_.size() >= worth_a_pass) flush(active, frustum);
        }
    }

    struct Span {
        Interval u, v;
    };
    /// Where the frustum's rays can be between two depths.
    [[nodiscard]] Span span_between(const Frustum& frustum, double from, double to) const {
        const Sweeps rays = sweeps_of<bundle>(packet_, frustum, corner_error_);
        return {.u = rays.u.between(from, to), .v = rays.v.between(from, to)};
    }

    /// The first slice from `slice` on whose macrocells hold anything that the frustum can reach, or one that
    /// lies behind what it can reach.
    /// @param until  becomes the slice behind those macrocells
    [[nodiscard]] int first_occupied(const Stage& at, const Frustum& frustum, int slice, int& until) const {
        const auto layer_of = [&](int s) { return packet_.axes.negative ? at.slices - 1 - s : s; };
        for (; slice < at.slices; slice = until) {
            const int layer = layer_of(slice);
            const int cube_begin = layer / rebuild::Macrocells::side * rebuild::Macrocells::side;
            const int cube_last = std::min(cube_begin + rebuild::Macrocells::side, at.slices) - 1;
            until = layer_of(packet_.axes.negative ? cube_begin : cube_last) + 1;
            const double from = std::max(double(frustum.near_depth), at.first_plane + slice * at.slice_depth);
            if (from > double(frustum.far_depth) * (1.0 + depth_error)) return slice;
            const Span across = span_between(frustum, from, at.first_plane + until * at.slice_depth);
            glm::ivec3 first, last;
            first[packet_.axes.k] = last[packet_.axes.k] = layer;
            first[packet_.axes.u()] = at.u.cell(across.u.low);
            last[packet_.axes.u()] = at.u.cell(across.u.high);
            first[packet_.axes.v()] = at.v.cell(across.v.low);
            last[packet_.axes.v()] = at.v.cell(across.v.high);
            if (scene_.macrocells->any_in(first, last)) return slice;
        }
        return slice;
    }

    /// The cells of a slice that the frustum overlaps, both ends included.
    struct Cells {
        int u0, u1, v0, v1;
        [[nodiscard]] std::int64_t count() const {
            return std::int64_t{u1 - u0 + 1} * std::int64_t{v1 - v0 + 1};
        }
    };

    /// The first slice that the frustum can touch: behind the nearest depth, and not before it reaches the
    /// box.
    [[nodiscard]] int first_slice(const Stage& at, const Frustum& frustum) const {
        double depth = std::max(double(frustum.near_depth) - corner_error_, at.first_plane);
        const auto wait_for = [&](const Across& axis, const Sweep& rays) {
            if (axis.high < rays.low && rays.low_slope < 0.0) {
                depth = std::max(depth, (axis.high - rays.low) / rays.low_slope);
            }
            if (axis.low > rays.high && rays.high_slope > 0.0) {
                depth = std::max(depth, (axis.low - rays.high) / rays.high_slope);
            }
        };
        const Sweeps rays = sweeps_of<bundle>(packet_, frustum, corner_error_);
        wait_for(at.u, rays.u);
        wait_for(at.v, rays.v);
        return static_cast<int>(
            std::clamp(std::floor((depth - at.first_plane) / at.slice_depth), 0.0, double(at.slices)));
    }

    void collect(const Stage& at, int slice, const Cells& cells, BlockMask& active, Frustum& frustum) {
        const auto layer =
            at.first_cell +
            static_cast<std::size_t>(packet_.axes.negative ? at.slices - 1 - slice : slice) * at.slice_stride;
        const auto cell = [&](int u, int v) {
            return layer + static_cast<std::size_t>(u) * at.u.stride +
                   static_cast<std::size_t>(v) * at.v.stride;
        };
        // Neighbours along x are one span of references.
        if (at.u.stride == 1) {
            for (int v = cells.v0; v <= cells.v1 && active != 0; ++v) {
                take(at, cell(cells.u0, v), cell(cells.u1, v) + 1, active, frustum);
            }
        } else if (at.v.stride == 1) {
            for (int u = cells.u0; u <= cells.u1 && active != 0; ++u) {
                take(at, cell(u, cells.v0), cell(u, cells.v1) + 1, active, frustum);
            }
        } else {
            for (int v = cells.v0; v <= cells.v1 && active != 0; ++v) {
                for (int u = cells.u0; u <= cells.u1; ++u) {
                    take(at, cell(u, v), cell(u, v) + 1, active, frustum);
                }
            }
        }
    }

    /// The triangles of cells [begin, end).
    HWY_INLINE void take(const Stage& at, std::size_t begin, std::size_t end, BlockMask& active,
                         Frustum& frustum) {
        const std::uint32_t last = at.level.cell_begin[end];
        std::uint32_t taken = lists_.take(at.level, at.level.cell_begin[begin], last);
        while (HWY_UNLIKELY(taken != last)) {
            const std::uint32_t* const stopped_at = at.level.references.data() + taken;
            if ((*stopped_at & rebuild::nested_mark) != 0) {
                if (active != 0) {
                    walk(stage(at.depth + 1, *stopped_at & ~rebuild::nested_mark), active, frustum, 0);
                }
                taken += stopped_at[1];
            } else {
                add_candidates(active, frustum);
            }
            taken = lists_.take(at.level, taken, last);
        }
    }

    /// Lets those triangles of the lists wait that the march has not met lately.
    void add_candidates(BlockMask& active, Frustum& frustum) {
        if (candidates_.size() + lists_.size() > Candidates::capacity) flush(active, frustum);
        for (const std::uint32_t triangle : lists_) {
            hwy::Prefetch(&scene_.triangles.triangles[triangle]);
            candidates_.add(triangle);
        }
        lists_.clear();
    }

    /// Gives the active blocks up if that much more work is too much. @return whether it is not
    HWY_INLINE bool afford(std::uint64_t more, BlockMask& active) {
        work_ += more;
        if (HWY_LIKELY(work_ <= work_limit_)) return true;
        given_up_ |= std::exchange(active, 0);
        return false;
    }

    void flush(BlockMask& active, Frustum& frustum) {
        if (candidates_.size() == 0) return;
        const std::uint64_t tests_before = report_.triangle_tests;
        if (!afford(candidates_.size() * work_of_candidate, active)) {
            candidates_.drop_all();
            return;
        }
        if constexpr (bundle == Bundle::loose) {
            intersect_loose<wanted>(scene_, packet_, active, frustum, candidates_, report_);
        } else {
            intersect<wanted, bundle>(scene_, packet_, active, frustum, candidates_, report_);
        }
        work_ += (report_.triangle_tests - tests_before) *
                 (bundle == Bundle::loose ? work_of_loose_test : work_of_test);
        update_reach(active, frustum);
    }

    void update_reach(BlockMask active, Frustum& frustum) const {
        float far_depth = -1.0f;
        for (BlockMask rest = active; rest != 0; rest &= rest - 1) {
            far_depth = std::max(far_depth, packet_.far_depth[std::countr_zero(rest)]);
        }
        frustum.far_depth = far_depth;
    }

    /// Halves the wider side of the frustum; each half goes on alone through this grid from the same slice.
    void split(const Stage& at, BlockMask& active, Frustum& frustum, int slice) {
        add_candidates(active, frustum);  // of the grid around this one
        flush(active, frustum);
        if (active == 0) return;
        BlockMask lower =
            lower_half<bundle>(packet_, active, frustum,
                               std::max(double(frustum.near_depth), at.first_plane + slice * at.slice_depth));
        if (lower == 0 || lower == active) {  // all blocks alike: any two halves will do
            lower = active;
            for (int dropped = std::popcount(active) / 2; dropped > 0; --dropped) lower &= lower - 1;
        }
        for (const BlockMask half : {lower, active & ~lower}) {
            if (half == 0) continue;  // the flush left a single block
            candidates_.forget();
            walk_alone(at, half, slice);
        }
        // Together again, in the grid around this one.
        candidates_.forget();
        for (BlockMask rest = active; rest != 0; rest &= rest - 1) {
            const int block = std::countr_zero(rest);
            if (packet_.far_depth[block] < 0.0f) active &= ~(BlockMask{1} << block);
        }
        active &= ~given_up_;
        update_reach(active, frustum);
    }

    const GridScene& scene_;
    Packet& packet_;
    Candidates& candidates_;
    CellLists lists_;
    TraceReport& report_;
    double corner_error_ = 0.0;  // metres across
    std::uint64_t work_ = 0, work_limit_ = no_limit;
    BlockMask given_up_ = 0;  // when the work became too much
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
