#include "rebuild/cell_range_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rebuild/cell_range_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "rebuild/read_position-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gridreel::rebuild {
namespace HWY_NAMESPACE {

struct LaneBox {
    Four min, max;
    bool traceable;
};

HWY_INLINE LaneBox box_of(const PositionReader& points, const glm::uvec3& corners) {
    const FourTag d;
    const Four a = points.at(corners.x), b = points.at(corners.y), c = points.at(corners.z);
    const Four limit = hn::Set(d, largest_coordinate);
    const auto within =
        hn::And(hn::Le(hn::Abs(a), limit), hn::And(hn::Le(hn::Abs(b), limit), hn::Le(hn::Abs(c), limit)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, within, bits);
    return {.min = hn::Min(a, hn::Min(b, c)),
            .max = hn::Max(a, hn::Max(b, c)),
            .traceable = (bits[0] & 7u) == 7u};
}

Bounds3 bounds_of(const TriangleView& view, const TriangleList& list, std::size_t begin, std::size_t end) {
    const FourTag d;
    const PositionReader points(view.positions);
    Four low = hn::Inf(d), high = hn::Neg(hn::Inf(d));
    for (std::size_t i = begin; i < end; ++i) {
        const LaneBox box = box_of(points, view.triangles[list[i]]);
        if (HWY_UNLIKELY(!box.traceable)) continue;
        low = hn::Min(low, box.min);
        high = hn::Max(high, box.max);
    }
    HWY_ALIGN float lows[4], highs[4];
    hn::Store(low, d, lows);
    hn::Store(high, d, highs);
    return {.min = {lows[0], lows[1], lows[2]}, .max = {highs[0], highs[1], highs[2]}};
}

std::uint64_t count_cells(const TriangleView& view, const TriangleList& list, std::size_t begin,
                          std::size_t end, const CellMapping& mapping, CellRange* ranges,
                          std::uint32_t* histogram, std::uint64_t limit) {
    const FourTag d;
    const hn::RebindToSigned<FourTag> di;
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
    const auto row = static_cast<std::size_t>(mapping.resolution().x);
    const auto layer = row * static_cast<std::size_t>(mapping.resolution().y);

    std::uint64_t references = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const LaneBox box = box_of(points, view.triangles[list[i]]);
        if (HWY_UNLIKELY(!box.traceable)) {
            ranges[i] = no_cells;
            continue;
        }
        const auto held = [&](Four cells) { return hn::ConvertTo(di, hn::Min(hn::Max(cells, zero), last)); };
        const auto first_cell = held(hn::Sub(hn::Mul(hn::Sub(box.min, origin), scale), slack));
        const auto last_cell = held(hn::Add(hn::Mul(hn::Sub(box.max, origin), scale), slack));
        HWY_ALIGN std::int32_t first[4], final[4];
        hn::Store(first_cell, di, first);
        hn::Store(last_cell, di, final);
        ranges[i] = {.first = {static_cast<std::uint16_t>(first[0]), static_cast<std::uint16_t>(first[1]),
                               static_cast<std::uint16_t>(first[2])},
                     .last = {static_cast<std::uint16_t>(final[0]), static_cast<std::uint16_t>(final[1]),
                              static_cast<std::uint16_t>(final[2])}};

        const auto across = [&](int axis) { return static_cast<std::size_t>(final[axis] - first[axis]) + 1; };
        references += across(0) * across(1) * across(2);
        if (HWY_UNLIKELY(references > limit)) break;
        std::uint32_t* corner = histogram + static_cast<std::size_t>(first[2]) * layer +
                                static_cast<std::size_t>(first[1]) * row + static_cast<std::size_t>(first[0]);
        for (std::size_t z = 0; z < across(2); ++z) {
            for (std::size_t y = 0; y < across(1); ++y) {
                std::uint32_t* cells = corner + z * layer + y * row;
                for (std::size_t x = 0; x < across(0); ++x) ++cells[x];
            }
        }
    }
    return references;
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::rebuild
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::rebuild {

HWY_EXPORT(bounds_of);
HWY_EXPORT(count_cells);

Bounds3 bounds_of(const TriangleView& view, const TriangleList& list, std::size_t begin, std::size_t end) {
    return HWY_DYNAMIC_DISPATCH(bounds_of)(view, list, begin, end);
}

std::uint64_t count_cells(const TriangleView& view, const TriangleList& list, std::size_t begin,
                          std::size_t end, const CellMapping& mapping, CellRange* ranges,
                          std::uint32_t* histogram, std::uint64_t limit) {
    return HWY_DYNAMIC_DISPATCH(count_cells)(view, list, begin, end, mapping, ranges, histogram, limit);
}

}  // namespace gridreel::rebuild
#endif
