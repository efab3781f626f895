// Vectors of as many vertices as a register has lanes. Included once per SIMD target.
// The same bits with every instruction set: no products are fused.

#if defined(GRIDREEL_ANIM_LANE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_ANIM_LANE_VECTORS_INL_H_
#undef GRIDREEL_ANIM_LANE_VECTORS_INL_H_
#else
#define GRIDREEL_ANIM_LANE_VECTORS_INL_H_
#endif

#include "anim/vertex_block.h"

#include <hwy/highway.h>

#include <glm/vec3.hpp>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace gridreel::anim {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, PaddedBlock::most_lanes>;
using Lanes = hn::Vec<Tag>;
using LaneMask = hn::Mask<Tag>;
constexpr std::size_t lane_count = hn::MaxLanes(Tag());

struct LaneVector {
    Lanes x, y, z;
};

/// A row of as many maps: the linear part, and the offset.
struct LaneRow {
    LaneVector linear;
    Lanes offset;
};

HWY_INLINE LaneVector same_in_all(const glm::vec3& v) {
    const Tag d;
    return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}

HWY_INLINE LaneVector difference(const LaneVector& a, const LaneVector& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Lanes dot(const LaneVector& a, const LaneVector& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE LaneVector cross(const LaneVector& a, const LaneVector& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

/// One component of a position's place in the world.
HWY_INLINE Lanes place(const LaneVector& position, const LaneRow& row, Lanes origin) {
    return hn::Add(origin, hn::Add(dot(position, row.linear), row.offset));
}

struct LaneDirection {
    LaneVector unit;  ///< means nothing where `exists` is false
    LaneMask exists;
};

/// `v` at unit length and `sign` times, as `unit` of direction_map.cpp: scaled before squaring, so that tiny
/// and huge vectors keep their direction. Zero, infinite and undefined vectors have none.
HWY_INLINE LaneDirection direction_of(const LaneVector& v, Lanes sign) {
    const Lanes largest = hn::Max(hn::Abs(v.x), hn::Max(hn::Abs(v.y), hn::Abs(v.z)));
    const LaneVector scaled{hn::Div(v.x, largest), hn::Div(v.y, largest), hn::Div(v.z, largest)};
    // At least 1, or not a number: 0/0, infinity/infinity, or what `v` had already.
    const Lanes square = dot(scaled, scaled);
    const Lanes shrink = hn::Div(sign, hn::Sqrt(square));
    return {.unit = {hn::Mul(scaled.x, shrink), hn::Mul(scaled.y, shrink), hn::Mul(scaled.z, shrink)},
            .exists = hn::Eq(square, square)};
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::anim
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
