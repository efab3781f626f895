#include "rebuild/reference_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rebuild/reference_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "rebuild/read_position-inl.h"
#include "rebuild/triangle_slabs-inl.h"

#include <algorithm>
#include <bit>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::rebuild {
namespace HWY_NAMESPACE {

/// Boxes of up to so many cells list their triangle in all of them: looking closer would cost more than it
/// saves.
constexpr std::size_t few_cells = 16;

struct LaneTriangle {
    Four a, b, c;

    [[nodiscard]] HWY_INLINE Four min() const { return hn::Min(a, hn::Min(b, c)); }
    [[nodiscard]] HWY_INLINE Four max() const { return hn::Max(a, hn::Max(b, c)); }
    /// Magnitudes are ordered as their bits are, with NaN behind all numbers.
    [[nodiscard]] HWY_INLINE bool traceable() const {
        const hn::RebindToSigned<FourTag> di;
        HWY_ALIGN constexpr std::int32_t magnitude_bits[4] = {0x7fffffff, 0x7fffffff, 0x7fffffff, 0};
        const auto bits = hn::Load(di, magnitude_bits);
        const auto size = [&](Four point) { return hn::And(hn::BitCast(di, point), bits); };
        const auto largest = hn::Max(size(a), hn::Max(size(b), size(c)));
        return hn::AllFalse(di,
                            hn::Gt(largest, hn::Set(di, std::bit_cast<std::int32_t>(largest_coordinate))));
    }
};

HWY_INLINE LaneTriangle read_triangle(const PositionReader& points, const glm::uvec3& corners) {
    return {.a = points.at(corners.x), .b = points.at(corners.y), .c = points.at(corners.z)};
}

Bounds3 bounds_of(const TriangleView& view, const TriangleList& list, std::size_t begin, std::size_t end) {
    const FourTag d;
    const PositionReader points(view.positions);
    Four low = hn::Inf(d), high = hn::Neg(hn::Inf(d));
    for (std::size_t i = begin; i < end; ++i) {
        const LaneTriangle triangle = read_triangle(points, view.triangles[list[i]]);
        if (HWY_UNLIKELY(!triangle.traceable())) continue;
        low = hn::Min(low, triangle.min());
        high = hn::Max(high, triangle.max());
    }
    HWY_ALIGN float lows[4], highs[4];
    hn::Store(low, d, lows);
    hn::Store(high, d, highs);
    return {.min = {lows[0], lows[1], lows[2]}, .max = {highs[0], highs[1], highs[2]}};
}

/// Whether the box has at most 4 x 2 x 2 cells.
HWY_INLINE bool is_small(const LaneRange& range) {
    return range.others[0] <= 3 && (range.others[1] | range.others[2]) <= 1;
}

HWY_INLINE void put_row(std::uint32_t first_cell, std::uint32_t* cells) {
    const hn::FixedTag<std::uint32_t, 4> d;
    hn::StoreU(hn::Add(hn::Iota(d, 0), hn::Set(d, first_cell)), d, cells);
}

/// Appends the cells of a small box without a branch: how many there are is anybody's guess. A row that is
/// not there is overwritten by the next.
HWY_INLINE void list_small_box(const LaneRange& range, const CellStrides& strides, ReferenceWriter& out) {
    const std::uint32_t row = strides.of(1), layer = strides.of(2);
    const std::uint32_t corner = strides.cell(range.first);
    const std::size_t x = range.across(0);
    const std::size_t slice = x << range.others[1];
    std::uint32_t* const cells = out.next();
    put_row(corner, cells);
    put_row(corner + row, cells + x);
    put_row(corner + layer, cells + slice);
    put_row(corner + layer + row, cells + slice + x * range.others[2]);
    out.advance(slice << range.others[2]);
}

/// Appends all cells of a box.
void list_box(const LaneRange& range, const CellStrides& strides, ReferenceWriter& out) {
    for (std::uint32_t z = 0; z <= range.others[2]; ++z) {
        for (std::uint32_t y = 0; y <= range.others[1]; ++y) {
            const std::uint32_t row = strides.cell(range.first) + z * strides.of(2) + y * strides.of(1);
            for (std::uint32_t x = 0; x <= range.others[0]; x += 4) {
                put_row(row + x, out.next());
                out.advance(std::min<std::uint32_t>(4, range.others[0] - x + 1));
            }
        }
    }
}

std::uint64_t find_references(const TriangleView& view, const TriangleList& list, std::size_t begin,
                              std::size_t end, const CellMapping& mapping, const ReferenceRoom& room,
                              std::uint64_t limit) {
    const FourTag d;
    const hn::RebindToUnsigned<FourTag> du;
    const PositionReader points(view.positions);
    const auto in_lanes = [&](const glm::vec3& v) {
        HWY_ALIGN const float lanes[4] = {v.x, v.y, v.z, 0.0f};
        return hn::Load(d, lanes);
    };
    const Four origin = in_lanes(mapping.origin());
    const Four scale = in_lanes(mapping.cells_per_metre());
    const Four slack = in_lanes(mapping.slack_cells());
    const Four last = in_lanes(mapping.last_cell());
    const Four zero = hn::Zero(d);
    const CellStrides strides(mapping.resolution());
    const SlabLister slabs(strides, mapping.slack_cells());
    const auto in_cells = [&](Four point) { return hn::Mul(hn::Sub(point, origin), scale); };
    const auto held = [&](Four cells) {
        return small_whole(d, hn::Floor(hn::Min(hn::Max(cells, zero), last)));
    };

    ReferenceWriter out(room);
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t index = list[i];
        const LaneTriangle triangle = read_triangle(points, view.triangles[index]);
        if (HWY_UNLIKELY(!triangle.traceable())) continue;
        const auto first_cell = held(hn::Sub(in_cells(triangle.min()), slack));
        const auto last_cell = held(hn::Add(in_cells(triangle.max()), slack));
        LaneRange range;
        hn::Store(first_cell, du, range.first);
        hn::Store(hn::Sub(last_cell, first_cell), du, range.others);

        const std::size_t before = out.count();
        if (HWY_LIKELY(is_small(range))) {
            list_small_box(range, strides, out);
        } else {
            const CellTriangle corners(in_cells(triangle.a), in_cells(triangle.b), in_cells(triangle.c));
            const std::size_t cells = range.across(0) * range.across(1) * range.across(2);
            if (cells <= few_cells || !slabs.list(corners, range, out)) list_box(range, strides, out);
        }
        out.name_triangle(before, index);
        if (HWY_UNLIKELY(out.count() > limit)) break;
    }
    return out.count();
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::rebuild
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::rebuild {

HWY_EXPORT(bounds_of);
HWY_EXPORT(find_references);

Bounds3 bounds_of(const TriangleView& view, const TriangleList& list, std::size_t begin, std::size_t end) {
    return HWY_DYNAMIC_DISPATCH(bounds_of)(view, list, begin, end);
}

std::uint64_t find_references(const TriangleView& view, const TriangleList& list, std::size_t begin,
                              std::size_t end, const CellMapping& mapping, const ReferenceRoom& room,
                              std::uint64_t limit) {
    return HWY_DYNAMIC_DISPATCH(find_references)(view, list, begin, end, mapping, room, limit);
}

}  // namespace gridreel::rebuild
#endif
