// The walk of one packet through the grid, slice by slice. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_
#undef GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PACKET_MARCH_INL_H_
#endif

#include "traversal/candidates.h"
#include "traversal/grid_scene.h"
#include "traversal/packet_intersect-inl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Triangles that must wait before they are worth a pass of 16 lanes.
constexpr std::size_t worth_a_pass = 8;
/// A packet that covers more cells than this per active block in one slice goes on as two.
constexpr std::int64_t cells_per_block_limit = 16;

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

struct Interval {
    double low, high;

    [[nodiscard]] Interval widened(double by) const { return {low - by, high + by}; }
};

/// Where rays with slopes in [low, high] can be between two depths >= 0.
Interval reach(double low_slope, double high_slope, double from, double to) {
    return {std::min(from * low_slope, to * low_slope), std::max(from * high_slope, to * high_slope)};
}

template <Wanted wanted>
class March {
public:
    March(const GridScene& scene, Packet& packet, Candidates& candidates, TraceReport& report)
        : scene_(scene), packet_(packet), candidates_(candidates), report_(report) {
        const rebuild::Grid& grid = scene.grid;
        const int k = packet.axes.k;
        const std::array<std::size_t, 3> stride{
            1, std::size_t(grid.resolution.x),
            std::size_t(grid.resolution.x) * std::size_t(grid.resolution.y)};
        const auto across = [&](int axis) {
            const auto i = static_cast<std::size_t>(axis);
            return Across{.low = double(grid.bounds.min[axis]) - double(packet.origin[axis]),
                          .high = double(grid.bounds.max[axis]) - double(packet.origin[axis]),
                          .cells_per_metre = 1.0 / grid.cell_size[axis],
                          .last = grid.resolution[axis] - 1,
                          .stride = stride[i]};
        };
        u_ = across(packet.axes.u());
        v_ = across(packet.axes.v());
        const Across along = across(k);
        slices_ = grid.resolution[k];
        slice_depth_ = grid.cell_size[k];
        slice_stride_ = along.stride;
        first_plane_ = packet.axes.negative ? -along.high : along.low;
        // Corners are rounded when they are taken relative to the origin: far away they stand beside their
        // cells.
        double farthest = 0.0;
        for (const Across& axis : {u_, v_, along}) farthest = std::max({farthest, -axis.low, axis.high});
        corner_error_ = farthest * 0x1p-23;
    }

    /// Traces the active blocks from `slice` on.
    void run(unsigned active, int slice) {
        Frustum frustum = frustum_of(packet_, active);
        slice = std::max(slice, first_slice(frustum));
        bool entered = false;
        for (; slice < slices_ && active != 0; ++slice) {
            // A hit in an earlier slice is final, one in this or a later slice is not yet.
            const double from = std::max(double(frustum.near_depth), first_plane_ + slice * slice_depth_);
            const double to = first_plane_ + (slice + 1) * slice_depth_;
            if (from > double(frustum.far_depth) * (1.0 + depth_error)) break;

            const Interval u = reach(double(frustum.centre_u) - double(frustum.half_u),
                                     double(frustum.centre_u) + double(frustum.half_u), from, to)
                                   .widened(corner_error_);
            const Interval v = reach(double(frustum.centre_v) - double(frustum.half_v),
                                     double(frustum.centre_v) + double(frustum.half_v), from, to)
                                   .widened(corner_error_);
            if (u.high < u_.low || u.low > u_.high || v.high < v_.low || v.low > v_.high) {
                if (entered) break;  // a frustum and a box are convex: it does not come back
                continue;
            }
            entered = true;

            const int u0 = u_.cell(u.low), u1 = u_.cell(u.high), v0 = v_.cell(v.low), v1 = v_.cell(v.high);
            const std::int64_t cells = std::int64_t{u1 - u0 + 1} * std::int64_t{v1 - v0 + 1};
            const int blocks = std::popcount(active);
            if (blocks > 1 && cells > cells_per_block_limit * blocks) {
                flush(active, frustum);
                if (active != 0) split(active, frustum_of(packet_, active), slice);
                return;
            }
            report_.cells += static_cast<std::uint64_t>(cells);
            collect(slice, u0, u1, v0, v1, active, frustum);
            if (candidates_.size() >= worth_a_pass) flush(active, frustum);
        }
        flush(active, frustum);
    }

private:
    /// The first slice that the frustum can touch: behind the nearest depth, and not before it reaches the
    /// box.
    [[nodiscard]] int first_slice(const Frustum& frustum) const {
        double depth = std::max(double(frustum.near_depth), first_plane_);
        const auto wait_for = [&](const Across& axis, double low_slope, double high_slope) {
            if (axis.high < 0.0 && low_slope < 0.0) depth = std::max(depth, axis.high / low_slope);
            if (axis.low > 0.0 && high_slope > 0.0) depth = std::max(depth, axis.low / high_slope);
        };
        wait_for(u_, double(frustum.centre_u) - double(frustum.half_u),
                 double(frustum.centre_u) + double(frustum.half_u));
        wait_for(v_, double(frustum.centre_v) - double(frustum.half_v),
                 double(frustum.centre_v) + double(frustum.half_v));
        return static_cast<int>(
            std::clamp(std::floor((depth - first_plane_) / slice_depth_), 0.0, double(slices_)));
    }

    void collect(int slice, int u0, int u1, int v0, int v1, unsigned& active, Frustum& frustum) {
        const auto layer =
            static_cast<std::size_t>(packet_.axes.negative ? slices_ - 1 - slice : slice) * slice_stride_;
        for (int v = v0; v <= v1; ++v) {
            const std::size_t row = layer + static_cast<std::size_t>(v) * v_.stride;
            if (u_.stride == 1) {  // neighbours along x: one span of references
                take(row + std::size_t(u0), row + std::size_t(u1) + 1, active, frustum);
                continue;
            }
            for (int u = u0; u <= u1; ++u) {
                const std::size_t cell = row + static_cast<std::size_t>(u) * u_.stride;
                take(cell, cell + 1, active, frustum);
            }
        }
    }

    /// The triangles of cells [begin, end).
    void take(std::size_t begin, std::size_t end, unsigned& active, Frustum& frustum) {
        const std::uint32_t last = scene_.grid.cell_begin[end];
        for (std::uint32_t i = scene_.grid.cell_begin[begin]; i < last; ++i) {
            candidates_.add(scene_.grid.references[i]);
            if (candidates_.full()) flush(active, frustum);
        }
    }

    void flush(unsigned& active, Frustum& frustum) {
        if (candidates_.size() == 0) return;
        intersect<wanted>(scene_, packet_, active, frustum, candidates_, report_);
        float far_depth = -1.0f;
        for (unsigned rest = active; rest != 0; rest &= rest - 1) {
            far_depth = std::max(far_depth, packet_.far_depth[std::countr_zero(rest)]);
        }
        frustum.far_depth = far_depth;
    }

    /// Halves the wider side of the frustum; each half goes on alone from the same slice.
    void split(unsigned active, const Frustum& frustum, int slice) {
        const bool by_u = frustum.half_u > frustum.half_v;
        unsigned lower = 0;
        for (unsigned rest = active; rest != 0; rest &= rest - 1) {
            const int block = std::countr_zero(rest);
            const bool below = by_u ? packet_.centre_u[block] < frustum.centre_u
                                    : packet_.centre_v[block] < frustum.centre_v;
            if (below) lower |= 1u << block;
        }
        if (lower == 0 || lower == active) {  // all blocks alike: any two halves will do
            lower = active;
            for (int dropped = std::popcount(active) / 2; dropped > 0; --dropped) lower &= lower - 1;
        }
        for (const unsigned half : {lower, active & ~lower}) {
            candidates_.forget();
            run(half, slice);
        }
    }

    const GridScene& scene_;
    Packet& packet_;
    Candidates& candidates_;
    TraceReport& report_;
    Across u_{}, v_{};
    int slices_ = 0;
    double slice_depth_ = 0.0;
    double first_plane_ = 0.0;  // depth at which the grid begins; may be negative
    std::size_t slice_stride_ = 0;
    double corner_error_ = 0.0;  // metres across
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
