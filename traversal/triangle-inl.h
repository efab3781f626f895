// Ray against triangle by edge functions, one triangle or one ray a lane. Included once per SIMD target.
//
// Relative to the ray's origin, the edge BC spans with it the plane through the origin with normal
// (B + C) x (C - B) = 2 (B x C). A ray direction d is inside when d . n >= 0 for all three edges, after the
// normals took the sign of the volume A . ((B - A) x (C - A)). This form of the normal changes sign exactly
// when B and C change places, so two triangles that share an edge leave no crack between them, and it keeps
// its precision for triangles much smaller than their distance.

#if defined(GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_
#undef GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_
#else
#define GRIDREEL_TRAVERSAL_TRIANGLE_INL_H_
#endif

#include <hwy/highway.h>

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

/// What of a triangle does not depend on the ray's slopes, seen from one origin along one K axis.
template <class V>
struct EdgeFunctions {
    Vec3<V> normal[3];  ///< edges BC, CA, AB; positive inside; `k` carries the sign of the ray's K direction
    V volume;           ///< twice the signed volume's size; 0 for a triangle seen edge-on, which is never hit
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
    const Vec3<V> n = cross(difference(b, a), difference(c, a));
    const V half = hn::MulAdd(a.k, n.k, hn::MulAdd(a.u, n.u, hn::Mul(a.v, n.v)));
    const V signed_volume = hn::Add(half, half);
    const V flip = hn::And(signed_volume, hn::SignBit(d));

    EdgeFunctions<V> edges{.normal = {edge_normal(b, c), edge_normal(c, a), edge_normal(a, b)},
                           .volume = hn::Abs(signed_volume),
                           .depth_min = {},
                           .depth_max = {}};
    for (Vec3<V>& normal : edges.normal) {
        normal.k = hn::Mul(hn::Xor(normal.k, flip), sign);
        normal.u = hn::Xor(normal.u, flip);
        normal.v = hn::Xor(normal.v, flip);
    }
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

/// The division is rounded, and for a triangle seen almost edge-on it is far off: the depth is held between
/// the corners', so that a hit always lies in the cells that hold its triangle.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Meeting<D> meet(D d, const EdgeFunctions<V>& edges, V slope_u, V slope_v) {
    V edge[3];
    for (int i = 0; i < 3; ++i) {
        const Vec3<V>& n = edges.normal[i];
        edge[i] = hn::MulAdd(slope_v, n.v, hn::MulAdd(slope_u, n.u, n.k));
    }
    const V zero = hn::Zero(d);
    const V total = hn::Add(hn::Add(edge[0], edge[1]), edge[2]);
    const auto inside = hn::And(hn::And(hn::Ge(edge[0], zero), hn::Ge(edge[1], zero)),
                                hn::And(hn::Ge(edge[2], zero), hn::Gt(hn::Min(total, edges.volume), zero)));
    const V depth = hn::Div(edges.volume, total);
    return {inside, hn::Max(edges.depth_min, hn::Min(edges.depth_max, depth))};
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
