// Ray against triangle by edge functions, one triangle or one ray a lane. Included once per SIMD target.
//
// Relative to the ray's origin, the edge BC spans with it the plane through the origin with normal
// (B + C) x (C - B) = 2 (B x C). A ray direction d is inside when d . n >= 0 for all three edges, after the
// normals took the sign of the volume A . ((B - A) x (C - A)). This form of the normal changes sign exactly
// when B and C change places, so two triangles that share an edge leave no crack between them, and it keeps
// its precision for triangles much smaller than their distance. What is nearer to an edge than rounding can
// tell is decided in double precision (exact_meeting.h).

#if defined(GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_
#undef GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_
#else
#define GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_
#endif

#include "traversal/exact_meeting.h"
#include "traversal/rounding.h"

#include <hwy/highway.h>

#include <cstddef>
#include <optional>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A point or normal a lane, in the order K, U, V of the ray's frame.
template <class V>
struct Vec3 {
    V k, u, v;
};

template <class V>
HWY_INLINE Vec3<V> sum(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::Add(a.k, b.k), hn::Add(a.u, b.u), hn::Add(a.v, b.v)};
}

template <class V>
HWY_INLINE Vec3<V> difference(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::Sub(a.k, b.k), hn::Sub(a.u, b.u), hn::Sub(a.v, b.v)};
}

template <class V>
HWY_INLINE Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
    return {hn::MulSub(a.u, b.v, hn::Mul(a.v, b.u)), hn::MulSub(a.v, b.k, hn::Mul(a.k, b.v)),
            hn::MulSub(a.k, b.u, hn::Mul(a.u, b.k))};
}

template <class V>
HWY_INLINE V size(const Vec3<V>& a) {
    return hn::Add(hn::Add(hn::Abs(a.k), hn::Abs(a.u)), hn::Abs(a.v));
}

/// What of a triangle does not depend on the ray's slopes, seen from one origin along one K axis.
template <class V>
struct EdgeFunctions {
    Vec3<V> normal[3];  ///< edges BC, CA, AB; positive inside; `k` carries the sign of the ray's K direction
    Vec3<V> plane;      ///< normal of the triangle's plane, with the same signs
    V volume;           ///< A . plane, >= 0; 0 or noise for a triangle seen edge-on
    V error;            ///< an edge function may be off by so much: nearer to zero it decides nothing
    V sure;             ///< above it a ray is inside, and its depth as exact as `depth_error` says
    V depth_min;        ///< nearest and farthest corner along the ray's K direction
    V depth_max;
};

template <class V>
HWY_INLINE Vec3<V> edge_normal(const Vec3<V>& from, const Vec3<V>& to) {
    return cross(sum(from, to), difference(to, from));
}

/// @param sign  1 or -1 a lane: the direction of the rays along K
template <class D, class V = hn::Vec<D>>
HWY_INLINE EdgeFunctions<V> edge_functions(D d, const Vec3<V>& a, const Vec3<V>& b, const Vec3<V>& c,
                                           V sign) {
    const Vec3<V> ab = difference(b, a);
    const Vec3<V> ac = difference(c, a);
    const Vec3<V> n = cross(ab, ac);
    const V signed_volume = hn::MulAdd(a.k, n.k, hn::MulAdd(a.u, n.u, hn::Mul(a.v, n.v)));
    const V flip = hn::And(signed_volume, hn::SignBit(d));

    EdgeFunctions<V> edges;
    edges.normal[0] = edge_normal(b, c);
    edges.normal[1] = edge_normal(c, a);
    edges.normal[2] = edge_normal(a, b);
    edges.plane = n;
    for (Vec3<V>* normal : {&edges.normal[0], &edges.normal[1], &edges.normal[2], &edges.plane}) {
        normal->k = hn::Mul(hn::Xor(normal->k, flip), sign);
        normal->u = hn::Xor(normal->u, flip);
        normal->v = hn::Xor(normal->v, flip);
    }
    // Each rounding on the way to an edge function is at most 2^-24 of |sum of ends| * |edge|, slopes being
    // at most 1; there are fewer than eight. `edge` bounds each edge, twice `reach` each sum of ends.
    const V size_ab = size(ab);
    const V size_ac = size(ac);
    const V edge = hn::Add(size_ab, size_ac);
    const V reach = hn::Add(size(a), edge);
    edges.error = hn::Mul(hn::Mul(hn::Set(d, 2.0f * rounding_margin), reach), edge);
    edges.volume = hn::Abs(signed_volume);
    // Volume and divisor round by as much of reach * |AB| * |AC|. Where they are small against that, the
    // triangle is seen at a low angle or is a sliver, and no float depth is good enough.
    const V scale = hn::Mul(hn::Mul(reach, size_ab), size_ac);
    const auto precise = hn::Ge(edges.volume, hn::Mul(hn::Set(d, 0x1p-7f), scale));
    edges.sure = hn::IfThenElse(precise, edges.error, hn::Inf(d));

    const V depth_a = hn::Mul(a.k, sign);
    const V depth_b = hn::Mul(b.k, sign);
    const V depth_c = hn::Mul(c.k, sign);
    edges.depth_min = hn::Min(depth_a, hn::Min(depth_b, depth_c));
    edges.depth_max = hn::Max(depth_a, hn::Max(depth_b, depth_c));
    return edges;
}

/// Where rays of the given slopes meet the triangle.
template <class D, class V = hn::Vec<D>>
struct Meeting {
    hn::Mask<D> inside;  ///< false for anything that involves a NaN
    V depth;             ///< along K; meaningless where not inside
};

/// @param best    hits behind it do not count: whether they are hits may be left undecided
/// @param decide  `std::optional<float> decide(lane)`: the exact answer for one lane, asked only where an
/// edge
///                function is too near to zero to tell
///
/// The division is rounded, and for a triangle seen almost edge-on it is far off: the depth is held between
/// the corners', so that a hit always lies in the cells that hold its triangle.
template <class D, class Decide, class V = hn::Vec<D>>
HWY_INLINE Meeting<D> meet(D d, const EdgeFunctions<V>& edges, V slope_u, V slope_v, V best,
                           const Decide& decide) {
    const auto along_ray = [&](const Vec3<V>& n) {
        return hn::MulAdd(slope_v, n.v, hn::MulAdd(slope_u, n.u, n.k));
    };
    const V least =
        hn::Min(along_ray(edges.normal[0]), hn::Min(along_ray(edges.normal[1]), along_ray(edges.normal[2])));
    // Most blocks that a triangle's cone reaches into have no ray in it.
    const auto touched = hn::And(hn::Ge(least, hn::Neg(edges.error)), hn::Le(edges.depth_min, best));
    if (hn::AllFalse(d, touched)) return {touched, best};

    auto inside = hn::And(touched, hn::Gt(least, edges.sure));
    // The edge functions add up to the same divisor, but each errs by its distance over its length more.
    V depth = hn::Div(edges.volume, along_ray(edges.plane));

    // Where the depth is precise and behind `best`, the doubt does not matter.
    const auto precise = hn::Lt(edges.sure, hn::Inf(d));
    const auto behind =
        hn::And(precise, hn::Gt(hn::Mul(depth, hn::Set(d, 1.0f - 2.0f * float(depth_error))), best));
    const auto doubtful = hn::AndNot(behind, hn::AndNot(inside, touched));
    if (HWY_UNLIKELY(!hn::AllFalse(d, doubtful))) {
        HWY_ALIGN float depths[HWY_MAX_BYTES / sizeof(float)];
        HWY_ALIGN float is_inside[HWY_MAX_BYTES / sizeof(float)];
        HWY_ALIGN float is_doubtful[HWY_MAX_BYTES / sizeof(float)];
        hn::Store(depth, d, depths);
        hn::Store(hn::IfThenElseZero(inside, hn::Set(d, 1.0f)), d, is_inside);
        hn::Store(hn::IfThenElseZero(doubtful, hn::Set(d, 1.0f)), d, is_doubtful);
        for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
            if (is_doubtful[lane] == 0.0f) continue;
            const std::optional<float> exact = decide(lane);
            is_inside[lane] = exact ? 1.0f : 0.0f;
            if (exact) depths[lane] = *exact;
        }
        depth = hn::Load(d, depths);
        inside = hn::Gt(hn::Load(d, is_inside), hn::Zero(d));
    }
    return {inside, hn::Max(edges.depth_min, hn::Min(edges.depth_max, depth))};
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
