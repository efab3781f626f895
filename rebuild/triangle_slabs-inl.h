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

#include "rebuild/read_position-inl.h"
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
    HWY_ALIGN float farthest[4];  ///< largest magnitude along each axis

    HWY_INLINE CellTriangle(Four a, Four b, Four c) {
        const FourTag d;
        hn::Store(a, d, point[0]);
        hn::Store(b, d, point[1]);
        hn::Store(c, d, point[2]);
        hn::Store(hn::Max(hn::Abs(a), hn::Max(hn::Abs(b), hn::Abs(c))), d, farthest);
    }
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
        const float farthest = std::max({triangle.farthest[0], triangle.farthest[1], triangle.farthest[2]});
        if (!(farthest < farthest_in_cells)) return false;
        // Corners are off by less than 2^-22 of their size, and what follows adds no more than that. Widening
        // slabs by three times the error of their corners keeps even the steepest edge's share of them.
        const float error = farthest * 0x1p-19f;

        // Nobody guesses the longest axis or the order of corners: no branches.
        const std::size_t longer = range.others[1] > range.others[0];
        const std::size_t third = range.others[2] > range.others[longer];
        const std::size_t k = longer + third * (2 - longer);
        const std::size_t u = k == 0;
        const std::size_t v = 2 - std::size_t{k == 2};
        const float* by_rank[3];
        const float at_k[3] = {triangle.point[0][k], triangle.point[1][k], triangle.point[2][k]};
        const int b_first = at_k[1] < at_k[0], c_before_a = at_k[2] < at_k[0], c_before_b = at_k[2] < at_k[1];
        by_rank[b_first + c_before_a] = triangle.point[0];
        by_rank[1 - b_first + c_before_b] = triangle.point[1];
        by_rank[2 - c_before_a - c_before_b] = triangle.point[2];
        const float *const low = by_rank[0], *const middle = by_rank[1], *const high = by_rank[2];
        const Edge whole(low, high, k, u, v), lower(low, middle, k, u, v), upper(middle, high, k, u, v);

        const auto across = [&](std::size_t axis) {
            return Across{.first = static_cast<float>(range.first[axis]),
                          .last = static_cast<float>(range.first[axis] + range.others[axis]),
                          .slack = slack_[axis] + error};
        };
        const Across across_k = across(k), across_u = across(u), across_v = across(v);
        const Lane slack = hn::Set(d, across_k.slack);
        const Lane bend_k = hn::Set(d, middle[k]), bend_u = hn::Set(d, middle[u]),
                   bend_v = hn::Set(d, middle[v]);
        for (float slab = across_k.first; slab <= across_k.last; slab += static_cast<float>(hn::Lanes(d))) {
            const Lane number = hn::Add(hn::Iota(d, 0.0f), hn::Set(d, slab));
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
            const auto slabs = hn::Le(number, hn::Set(d, across_k.last));
            append(slabs, number, {k, u, v}, in_u, in_v, out);
        }
        return true;
    }

private:
    /// More lanes would idle: few triangles cross more slabs.
    using Tag = hn::CappedTag<float, 8>;
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

    /// The box's cells along one axis.
    struct Across {
        float first, last, slack;
    };

    /// Cells of each slab along U or V, whole numbers.
    struct LaneSpan {
        Lane first;
        Lane others;  ///< how many follow the first; negative: not even that
    };

    static HWY_INLINE LaneSpan span(const Across& across, Lane min, Lane max) {
        const Lane slack = hn::Set(d, across.slack);
        const Lane low = hn::Max(hn::Sub(min, slack), hn::Set(d, across.first));
        const Lane high = hn::Min(hn::Add(max, slack), hn::Set(d, across.last));
        const Lane first = hn::Floor(low);
        return {.first = first, .others = hn::Sub(hn::Floor(high), first)};
    }

    struct Axes {
        std::size_t k, u, v;
    };

    /// One cell of every slab at a time.
    HWY_INLINE void append(LaneMask slabs, Lane number, const Axes& axes, const LaneSpan& in_u,
                           const LaneSpan& in_v, ReferenceWriter& to) const {
        const auto stride = [&](std::size_t axis) { return hn::Set(du, strides_.of(axis)); };
        const CellLane step_u = stride(axes.u), step_v = stride(axes.v);
        const CellLane layer = hn::Mul(small_whole(d, number), stride(axes.k));
        CellLane row = hn::Add(layer, hn::Add(hn::Mul(small_whole(d, in_u.first), step_u),
                                              hn::Mul(small_whole(d, in_v.first), step_v)));
        ReferenceWriter out = to;  // a copy stays in registers
        const auto take = [&](LaneMask some, CellLane cells) {
            hn::StoreU(hn::Compress(cells, hn::RebindMask(du, some)), du, out.next());
            out.advance(hn::CountTrue(d, some));
        };
        const auto reach_u = [&](float i) { return hn::Ge(in_u.others, hn::Set(d, i)); };
        const auto reach_v = [&](float j) { return hn::And(slabs, hn::Ge(in_v.others, hn::Set(d, j))); };
        const auto first_row = reach_v(0.0f), second_row = reach_v(1.0f);
        if (HWY_LIKELY(hn::AllTrue(d, hn::Lt(hn::Max(in_u.others, in_v.others), hn::Set(d, 2.0f))))) {
            // Needles: no loop whose length has to be guessed.
            const auto first = reach_u(0.0f), second = reach_u(1.0f);
            take(hn::And(first_row, first), row);
            take(hn::And(first_row, second), hn::Add(row, step_u));
            take(hn::And(second_row, first), hn::Add(row, step_v));
            take(hn::And(second_row, second), hn::Add(hn::Add(row, step_u), step_v));
        } else {
            for (float j = 0.0f;; ++j) {
                const auto in_row = reach_v(j);
                if (hn::AllFalse(d, in_row)) break;
                CellLane cells = row;
                for (float i = 0.0f;; ++i) {
                    const auto in_cell = hn::And(in_row, reach_u(i));
                    if (hn::AllFalse(d, in_cell)) break;
                    take(in_cell, cells);
                    cells = hn::Add(cells, step_u);
                }
                row = hn::Add(row, step_v);
            }
        }
        to = out;
    }

    const CellStrides& strides_;
    float slack_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::rebuild
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
