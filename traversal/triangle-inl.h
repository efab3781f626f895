// Ray against triangle by edge functions, one triangle or one ray a lane. Included once per SIMD target.
//
// Relative to the ray's origin, the edge BC spans with it the plane through the origin with normal
// (B + C) x (C - B) = 2 (B x C). A ray direction d is inside when d . n >= 0 for all three edges, after the
// normals took the sign of the volume A . ((B - A) x (C - A)). This form of the normal changes sign exactly
// when B and C change places, so two triangles that share an edge leave no crack between them, and it keeps
// its precision for triangles much smaller than their distance.
//
// Edge functions are taken in coordinates sheared along K so that a chosen ray, the aim, runs along the axis
// (for one ray: Woop, Benthin & Wald 2013, section 3). A shear keeps determinants, and what is left to round
// is the distance from the aim instead of the distance from the origin. What is nearer to an edge than
// rounding can tell is decided in double precision (exact_meeting.h).

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
HWY_INLINE Vec3<V> magnitudes(const Vec3<V>& a) {
    return {hn::Abs(a.k), hn::Abs(a.u), hn::Abs(a.v)};
}

template <class V>
HWY_INLINE V size(const Vec3<V>& a) {
    return hn::Add(hn::Add(hn::Abs(a.k), hn::Abs(a.u)), hn::Abs(a.v));
}

/// Slopes a lane.
template <class V>
struct Slopes {
    V u, v;
};

template <class V>
HWY_INLINE Slopes<V> difference(const Slopes<V>& a, const Slopes<V>& b) {
    return {hn::Sub(a.u, b.u), hn::Sub(a.v, b.v)};
}

/// The slopes a triangle is seen at, less the aim's: boxes, wide enough for rounding.
template <class V>
struct SlopeBox {
    V low_u, high_u, low_v, high_v;
};

/// The normal times the direction (1, u, v).
template <class V>
HWY_INLINE V along(const Vec3<V>& normal, const Slopes<V>& slopes) {
    return hn::MulAdd(slopes.v, normal.v, hn::MulAdd(slopes.u, normal.u, normal.k));
}

/// The ray that triangles are seen along, and how far the slopes of others may differ from its.
template <class V>
struct Aim {
    Slopes<V> slopes;
    V half;
};

/// What of a triangle does not depend on the ray's slopes, seen from one origin along one aim.
template <class V>
struct EdgeFunctions {
    Vec3<V> normal[3];  ///< edges BC, CA, AB, for slopes less the aim's; positive inside
    Vec3<V> plane;      ///< normal of the triangle's plane, for whole slopes, with the same sign
    V volume;           ///< A . plane, >= 0; 0 or noise for a triangle seen edge-on
    V error;            ///< an edge function may be off by so much: nearer to zero it decides nothing
    V sure;             ///< above it a ray is inside; infinite where no depth is as exact as `depth_error`
    V depth_min;        ///< nearest and farthest corner along the ray's K direction
    V depth_max;
};

/// @param sign  1 or -1 a lane: the direction of the rays along K
template <class D, class V = hn::Vec<D>>
HWY_INLINE EdgeFunctions<V> edge_functions(D d, Vec3<V> a, Vec3<V> b, Vec3<V> c, V sign, const Aim<V>& aim) {
    for (Vec3<V>* corner : {&a, &b, &c}) corner->k = hn::Mul(corner->k, sign);
    const Vec3<V> ab = difference(b, a);
    const Vec3<V> ac = difference(c, a);
    const Vec3<V> n = cross(ab, ac);
    const V signed_volume = hn::MulAdd(a.k, n.k, hn::MulAdd(a.u, n.u, hn::Mul(a.v, n.v)));
    const V flip = hn::And(signed_volume, hn::SignBit(d));
    const auto flipped = [&](const Vec3<V>& normal) {
        return Vec3<V>{hn::Xor(normal.k, flip), hn::Xor(normal.u, flip), hn::Xor(normal.v, flip)};
    };
    const auto sheared = [&](const Vec3<V>& p) {
        return Vec3<V>{p.k, hn::NegMulAdd(aim.slopes.u, p.k, p.u), hn::NegMulAdd(aim.slopes.v, p.k, p.v)};
    };
    const Vec3<V> sheared_a = sheared(a), sheared_b = sheared(b), sheared_c = sheared(c);
    const auto edge_normal = [&](const Vec3<V>& from, const Vec3<V>& to, const Vec3<V>& edge) {
        return flipped(cross(sum(from, to), sheared(edge)));
    };

    EdgeFunctions<V> edges;
    edges.normal[0] = edge_normal(sheared_b, sheared_c, difference(c, b));
    edges.normal[1] = edge_normal(sheared_c, sheared_a, difference(a, c));
    edges.normal[2] = edge_normal(sheared_a, sheared_b, ab);
    edges.plane = flipped(n);
    edges.volume = hn::Abs(signed_volume);
    edges.depth_min = hn::Min(a.k, hn::Min(b.k, c.k));
    edges.depth_max = hn::Max(a.k, hn::Max(b.k, c.k));

    // With |p| for the sum of a vector's magnitudes, the roundings on the way to an edge function add up to
    // less than 32 times 2^-24 |edge| (|corner across| + half |corner|); a shear in two roundings instead of
    // one adds what a half of 1 would.
    const V size_ab = size(ab);
    const V size_ac = size(ac);
    const V edge = hn::Add(size_ab, size_ac);
    const V reach = hn::Add(size(a), edge);
    const auto across = [](const Vec3<V>& p) { return hn::Add(hn::Abs(p.u), hn::Abs(p.v)); };
    const V aside = hn::Max(across(sheared_a), hn::Max(across(sheared_b), across(sheared_c)));
    const V half = HWY_NATIVE_FMA ? aim.half : hn::Add(aim.half, hn::Set(d, 1.0f));
    const V spread = hn::MulAdd(half, reach, aside);
    // Volume and divisor round by `rounding_margin` of reach * |AB| * |AC|. Where they are small against
    // that, the triangle is seen at a low angle or is a sliver, and no float depth is good enough.
    const V scale = hn::Mul(hn::Mul(reach, size_ab), size_ac);
    constexpr float least_precise = 2.0f * rounding_margin / float(depth_error);
    // Products of even smaller lengths underflow: nothing is known of their signs.
    const V edge_times_reach = hn::Mul(reach, edge);
    const auto no_underflow = hn::Ge(hn::Mul(edge_times_reach, edge), hn::Set(d, 0x1p-80f));
    const auto precise =
        hn::And(no_underflow, hn::Ge(edges.volume, hn::Mul(hn::Set(d, least_precise), scale)));

    // Not even the volume's sign may be right, which all edge functions share. They add up to twice the
    // volume over the depth of what they hit.
    V doubt = spread;
    const auto sign_is_sure =
        hn::And(no_underflow, hn::Ge(edges.volume, hn::Mul(hn::Set(d, rounding_margin), scale)));
    if (HWY_UNLIKELY(!hn::AllTrue(d, sign_is_sure))) {
        const V sign_doubt = hn::Div(edge_times_reach, hn::Max(edges.depth_min, hn::Zero(d)));
        doubt = hn::IfThenElse(sign_is_sure, doubt,
                               hn::IfThenElse(no_underflow, hn::Add(doubt, sign_doubt), hn::Inf(d)));
    }
    edges.error = hn::Mul(hn::Mul(hn::Set(d, 4.0f * rounding_margin), doubt), edge);
    edges.sure = hn::IfThenElse(precise, edges.error, hn::Inf(d));
    return edges;
}

/// The least of the three edge functions, for slopes less the aim's.
template <class V>
HWY_INLINE V least_edge(const EdgeFunctions<V>& edges, const Slopes<V>& offset) {
    return hn::Min(along(edges.normal[0], offset),
                   hn::Min(along(edges.normal[1], offset), along(edges.normal[2], offset)));
}

/// Where rays of the given slopes meet the triangle.
template <class D, class V = hn::Vec<D>>
struct Meeting {
    hn::Mask<D> inside;  ///< false for anything that involves a NaN
    V depth;             ///< along K; meaningless where not inside
};

/// The answer has the same bits whatever the aim, so all tracers agree.
/// @param least   `least_edge` of each ray
/// @param best    hits behind it do not count: whether they are hits may be left undecided
/// @param decide  `std::optional<float> decide(lane)`: the exact answer for one lane, asked only where an
/// edge function is too near to zero to tell, or where the depth needs it
///
/// The division is rounded, and for a triangle seen almost edge-on it is far off: the depth is held between
/// the corners', so that a hit always lies in the cells that hold its triangle.
template <class D, class Decide, class V = hn::Vec<D>>
HWY_INLINE Meeting<D> meet(D d, const EdgeFunctions<V>& edges, V least, const Slopes<V>& slopes, V best,
                           const Decide& decide) {
    // Most blocks that a triangle's cone reaches into have no ray in it.
    const auto touched = hn::And(hn::Ge(least, hn::Neg(edges.error)), hn::Le(edges.depth_min, best));
    if (hn::AllFalse(d, touched)) return {touched, best};

    auto inside = hn::And(touched, hn::Gt(least, edges.sure));
    // The edge functions add up to twice this divisor, but each errs by its distance over its length more.
    V depth = hn::Div(edges.volume, along(edges.plane, slopes));

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
        // The aim decides which lanes were in doubt: a precise depth stays as it was.
        depth = hn::IfThenElse(precise, depth, hn::Load(d, depths));
        inside = hn::Gt(hn::Load(d, is_inside), hn::Zero(d));
    }
    return {inside, hn::Max(edges.depth_min, hn::Min(edges.depth_max, depth))};
}

/// Triangles, one a lane, against one ray, which is its own aim.
/// @param sign, best, decide  as above
template <class D, class Decide, class V = hn::Vec<D>>
HWY_INLINE Meeting<D> meet_one_ray(D d, const Vec3<V>& a, const Vec3<V>& b, const Vec3<V>& c, V sign,
                                   const Slopes<V>& slopes, V best, const Decide& decide) {
    const auto edges = edge_functions(d, a, b, c, sign, Aim<V>{.slopes = slopes, .half = hn::Zero(d)});
    const V least = hn::Min(edges.normal[0].k, hn::Min(edges.normal[1].k, edges.normal[2].k));
    return meet(d, edges, least, slopes, best, decide);
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
