// The cells that a large triangle really comes near, slab by slab. Included once per SIMD target.
//
// The grid is cut into slabs of cells across the axis K along which the triangle's box has most cells. Inside
// a slab the triangle is a polygon, whose extents along the other two axes are those of its corners: where
// the longest edge and the two others (a bent path) enter and leave the slab, and the bend. All cells of the
// slab in these extents list the triangle. For a needle this is little more than the cells it passes.

#if defined(GRIDREEL_REBUILD_TRIANGLE_SLABS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_REBUILD_TRIANGLE_SLABS_INL_H_
#undef GRIDREEL_REBUILD_TRIANGLE_SLABS_INL_H_
#else
#define GRIDREEL_REBUILD_TRIANGLE_SLABS_INL_H_
#endif

#include "rebuild/reference_writer-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::rebuild {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Corners in units of cells from the grid's corner; the fourth lane means nothing.
struct CellTriangle {
    HWY_ALIGN float point[3][4];
};

class SlabLister {
public:
    /// @param slack  cells by which triangles are widened along each axis
    SlabLister(const CellStrides& strides, const glm::vec3& slack)
        : strides_(strides), slack_{slack.x, slack.y, slack.z} {}

    /// Appends the cells of `range`, the triangle's box, that the triangle comes within the slack of, and few
    /// others.
    /// @return false, and nothing appended, if single precision cannot tell
    bool list(const CellTriangle& triangle, const LaneRange& range, ReferenceWriter& out) const {
        float farthest = 0.0f;
        for (const auto& point : triangle.point) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                farthest = std::max(farthest, std::fabs(point[axis]));
            }
        }
        if (!(farthest < farthest_in_cells)) return false;
        // Corners are off by less than 2^-22 of their size, and what follows adds no more than that. Widening
        // slabs by three times the error of their corners keeps even the steepest edge's share of them.
        const float error = farthest * 0x1p-19f;

        const std::size_t k = range.across(0) >= range.across(1)
                                  ? (range.across(0) >= range.across(2) ? 0 : 2)
                                  : (range.across(1) >= range.across(2) ? 1 : 2);
        const std::size_t u = k == 0 ? 1 : 0;
        const std::size_t v = k == 2 ? 1 : 2;
        const float *low = triangle.point[0], *middle = triangle.point[1], *high = triangle.point[2];
        const auto sort = [k](const float*& a, const float*& b) {
            const bool swap = b[k] < a[k];
            const float* const less = swap ? b : a;
            b = swap ? a : b;
            a = less;
        };
        sort(low, middle);
        sort(middle, high);
        sort(low, middle);
        const Edge whole(low, high, k, u, v), lower(low, middle, k, u, v), upper(middle, high, k, u, v);

        const Across across_u{.first = range.first[u], .last = range.last[u], .slack = slack_[u] + error};
        const Across across_v{.first = range.first[v], .last = range.last[v], .slack = slack_[v] + error};
        const Lane slack = hn::Set(d, slack_[k] + error);
        const Lane bend_k = hn::Set(d, middle[k]), bend_u = hn::Set(d, middle[u]),
                   bend_v = hn::Set(d, middle[v]);
        for (std::int32_t slab = range.first[k]; slab <= range.last[k];
             slab += static_cast<std::int32_t>(hn::Lanes(d))) {
            const Lane number = hn::Iota(d, static_cast<float>(slab));
            const Lane enter = hn::Sub(number, slack);
            const Lane leave = hn::Add(hn::Add(number, hn::Set(d, 1.0f)), slack);

            Extents extents(whole.at(enter));
            extents.extend(whole.at(leave));
            extents.extend(on_path(lower, upper, hn::Lt(enter, bend_k), enter));
            extents.extend(on_path(lower, upper, hn::Lt(leave, bend_k), leave));
            const auto bends = hn::And(hn::Le(enter, bend_k), hn::Le(bend_k, leave));
            extents.extend(
                {hn::IfThenElse(bends, bend_u, extents.min_u), hn::IfThenElse(bends, bend_v, extents.min_v)});

            const LaneSpan in_u = span(across_u, extents.min_u, extents.max_u);
            const LaneSpan in_v = span(across_v, extents.min_v, extents.max_v);
            const auto there = hn::Le(number, hn::Set(d, static_cast<float>(range.last[k])));
            append(hn::And(there, hn::And(in_u.there, in_v.there)), slab, {k, u, v}, in_u, in_v, out);
        }
        return true;
    }

private:
    using Tag = hn::CappedTag<float, ReferenceRoom::padding>;
    using Lane = hn::Vec<Tag>;  ///< one slab a lane
    using LaneMask = hn::Mask<Tag>;
    using CellTag = hn::RebindToUnsigned<Tag>;
    using CellLane = hn::Vec<CellTag>;
    static constexpr Tag d{};
    static constexpr CellTag du{};

    /// Farther corners are too uncertain: the error would be half a cell.
    static constexpr float farthest_in_cells = 0x1p18f;

    struct Point {
        Lane u, v;
    };

    struct Extents {
        Lane min_u, max_u, min_v, max_v;

        HWY_INLINE explicit Extents(const Point& p) : min_u(p.u), max_u(p.u), min_v(p.v), max_v(p.v) {}
        HWY_INLINE void extend(const Point& p) {
            min_u = hn::Min(min_u, p.u);
            max_u = hn::Max(max_u, p.u);
            min_v = hn::Min(min_v, p.v);
            max_v = hn::Max(max_v, p.v);
        }
    };

    struct Edge {
        float k, u, v, to_u, to_v, per_k;

        HWY_INLINE Edge(const float* from, const float* to, std::size_t axis_k, std::size_t axis_u,
                        std::size_t axis_v)
            : k(from[axis_k]),
              u(from[axis_u]),
              v(from[axis_v]),
              to_u(to[axis_u] - u),
              to_v(to[axis_v] - v),
              per_k(1.0f / std::max(to[axis_k] - k, 0x1p-60f)) {}  // finite, so that 0 times it is 0

        /// The edge's point at K, or the end that is nearer to it.
        [[nodiscard]] HWY_INLINE Point at(Lane at_k) const {
            return along(at_k, hn::Set(d, k), hn::Set(d, per_k), {hn::Set(d, u), hn::Set(d, v)},
                         {hn::Set(d, to_u), hn::Set(d, to_v)});
        }
    };

    static HWY_INLINE Point along(Lane at_k, Lane k, Lane per_k, const Point& from, const Point& to) {
        const Lane part = hn::Mul(hn::Sub(at_k, k), per_k);
        const Lane held = hn::Min(hn::Max(part, hn::Zero(d)), hn::Set(d, 1.0f));
        return {hn::Add(from.u, hn::Mul(held, to.u)), hn::Add(from.v, hn::Mul(held, to.v))};
    }

    static HWY_INLINE Point on_path(const Edge& lower, const Edge& upper, LaneMask on_lower, Lane at_k) {
        const auto pick = [&](float of_lower, float of_upper) {
            return hn::IfThenElse(on_lower, hn::Set(d, of_lower), hn::Set(d, of_upper));
        };
        return along(at_k, pick(lower.k, upper.k), pick(lower.per_k, upper.per_k),
                     {pick(lower.u, upper.u), pick(lower.v, upper.v)},
                     {pick(lower.to_u, upper.to_u), pick(lower.to_v, upper.to_v)});
    }

    /// The box's cells along U or V.
    struct Across {
        std::int32_t first, last;
        float slack;
    };

    /// Cells of each slab along U or V.
    struct LaneSpan {
        CellLane first, count;
        LaneMask there;
    };

    static HWY_INLINE LaneSpan span(const Across& across, Lane min, Lane max) {
        const hn::RebindToSigned<Tag> di;
        const Lane first = hn::Set(d, static_cast<float>(across.first));
        const Lane last = hn::Set(d, static_cast<float>(across.last));
        const Lane low = hn::Sub(min, hn::Set(d, across.slack));
        const Lane high = hn::Add(max, hn::Set(d, across.slack));
        const auto first_cell = hn::ConvertTo(di, hn::Min(hn::Max(low, first), last));
        const auto last_cell = hn::ConvertTo(di, hn::Min(hn::Max(high, first), last));
        return {.first = hn::BitCast(du, first_cell),
                .count = hn::BitCast(du, hn::Add(hn::Sub(last_cell, first_cell), hn::Set(di, 1))),
                .there = hn::And(hn::Ge(high, first), hn::Lt(low, hn::Add(last, hn::Set(d, 1.0f))))};
    }

    struct Axes {
        std::size_t k, u, v;
    };

    /// One cell of every slab at a time.
    HWY_INLINE void append(LaneMask there, std::int32_t slab, const Axes& axes, const LaneSpan& in_u,
                           const LaneSpan& in_v, ReferenceWriter& out) const {
        const auto stride = [&](std::size_t axis) { return hn::Set(du, strides_.of(axis)); };
        const auto slabs = hn::RebindMask(du, there);
        CellLane row =
            hn::Add(hn::Mul(hn::Iota(du, static_cast<std::uint32_t>(slab)), stride(axes.k)),
                    hn::Add(hn::Mul(in_u.first, stride(axes.u)), hn::Mul(in_v.first, stride(axes.v))));
        for (std::uint32_t j = 0;; ++j) {
            const auto in_row = hn::And(slabs, hn::Gt(in_v.count, hn::Set(du, j)));
            if (hn::AllFalse(du, in_row)) break;
            CellLane cells = row;
            for (std::uint32_t i = 0;; ++i) {
                const auto in_cell = hn::And(in_row, hn::Gt(in_u.count, hn::Set(du, i)));
                if (hn::AllFalse(du, in_cell)) break;
                out.put(du, 0, hn::Compress(cells, in_cell));
                out.advance(hn::CountTrue(du, in_cell));
                cells = hn::Add(cells, stride(axes.u));
            }
            row = hn::Add(row, stride(axes.v));
        }
    }

    const CellStrides& strides_;
    float slack_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::rebuild
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
