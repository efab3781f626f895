// Triangles as parallel rays see them, for culling: by edge functions of places. Included once per SIMD
// target.
//
// A shear along K by the rays' common slopes turns every ray into a place in the plane across K, and a
// triangle into one in that plane. A ray is inside when it lies on the same side of all three edges: for the
// edge from A to B, (B - A) x (P - A) = n.k + n.u P.u + n.v P.v, the form that edge functions of a pencil
// have in its slopes. What is culled and what is left to be decided by `meet_one_ray` depends on what these
// places may be off by.
//
// Let e be 2^-24 and R the greatest difference between a coordinate of the packet's origin and one of a ray's
// origin or of the grid's box. The place of a ray and that of a corner are each off by 5 e R: by e R for
// either coordinate relative to the packet's origin, and by 3 e R for the shear, whose result is at most 2 R
// (one rounding with fused multiply-add, two without). A lone ray sees corners relative to its own origin, up
// to 2 R away: off by 2 e R on either axis, and 4 e R in their place. So a ray that meets the triangle for
// `meet_one_ray` has its place within 14 e R of the triangle of computed corners, along either axis:
// `place_error` is 16 e R. Less the aim's place, at most 4 R away, both err by 4 e R more: 22 e R in all.
//
// Depths from the packet's origin err by e R, both of a corner and of where a ray begins, their difference by
// 2 e R more, and what the lone ray sees by 2 e R: less than `place_error`.

#if defined(GRIDREEL_TRAVERSAL_PARALLEL_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PARALLEL_TRIANGLE_INL_H_
#undef GRIDREEL_TRAVERSAL_PARALLEL_TRIANGLE_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PARALLEL_TRIANGLE_INL_H_
#endif

#include "traversal/rounding.h"
#include "traversal/triangle-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// A triangle's corners where rays of one direction see them.
template <class V>
struct Places {
    Slopes<V> a, b, c;    ///< metres across, less the aim's place
    V nearest, farthest;  ///< corner along the rays' K direction
    V steepest;           ///< product of two edges in space
};

/// @param a, b, c  relative to the packet's origin, K not yet along the rays
/// @param sign     1 or -1 a lane: the direction of the rays along K
/// @param aim      a place
template <class D, class V = hn::Vec<D>>
HWY_INLINE Places<V> places_along(D, Vec3<V> a, Vec3<V> b, Vec3<V> c, V sign, const Slopes<V>& slopes,
                                  const Slopes<V>& aim) {
    for (Vec3<V>* corner : {&a, &b, &c}) corner->k = hn::Mul(corner->k, sign);
    const auto place = [&](const Vec3<V>& p) HWY_ATTR {
        return difference(Slopes<V>{hn::NegMulAdd(slopes.u, p.k, p.u), hn::NegMulAdd(slopes.v, p.k, p.v)},
                          aim);
    };
    return {.a = place(a),
            .b = place(b),
            .c = place(c),
            .nearest = hn::Min(a.k, hn::Min(b.k, c.k)),
            .farthest = hn::Max(a.k, hn::Max(b.k, c.k)),
            .steepest = hn::Mul(size(difference(b, a)), size(difference(c, a)))};
}

/// The least box around the corners, widened for a test against a box of places, which rounds by 12 e R.
/// @param place_error  metres
template <class V>
HWY_INLINE SlopeBox<V> place_box(const Places<V>& at, V place_error) {
    const V margin = hn::Add(place_error, place_error);
    return {.low_u = hn::Sub(hn::Min(at.a.u, hn::Min(at.b.u, at.c.u)), margin),
            .high_u = hn::Add(hn::Max(at.a.u, hn::Max(at.b.u, at.c.u)), margin),
            .low_v = hn::Sub(hn::Min(at.a.v, hn::Min(at.b.v, at.c.v)), margin),
            .high_v = hn::Add(hn::Max(at.a.v, hn::Max(at.b.v, at.c.v)), margin)};
}

/// Edge functions for places less the aim's. A ray for which one is below -`error` misses for
/// `meet_one_ray`, too; one for which all are above `sure` is inside for it. Depths, from the packet's
/// origin, are those of the corners, widened by `place_error`. There are no `plane` and `volume`.
///
/// With |p| for the sum of magnitudes, a ray whose place is within 22 e R of the triangle has no edge
/// function below -22 e R |edge|. Its roundings are less than 8 e |edge| (|corner| + |place|), and the side
/// on which the triangle lies is known but for 16 e |edge|^2, when its edge functions are no larger than
/// that. To be sure takes twice as much: moving corners by 22 e R changes an edge function of a ray within
/// the triangle by 44 e R |edge|, and by less than a quarter of that more, since no triangle whose edges are
/// shorter than 88 e R has a ray that deep inside.
///
/// A lone ray may be wrong about triangles seen edge-on, whose volume is noise. So nothing is sure of one
/// whose area, as the rays see it, is less than 2^-8 of its edges' product: other volumes, of depths of at
/// least `place_error`, are at least 2^-28 of R times that product, and in double err by 2^-47 of it.
///
/// @param half  of the places of all rays, less the aim's
template <class D, class V = hn::Vec<D>>
HWY_INLINE EdgeFunctions<V> edge_functions(D d, const Places<V>& at, V half, V place_error) {
    const auto ab = difference(at.b, at.a), bc = difference(at.c, at.b), ca = difference(at.a, at.c);
    const V area = hn::MulSub(ab.v, ca.u, hn::Mul(ab.u, ca.v));
    const V flip = hn::And(area, hn::SignBit(d));
    const auto normal = [&](const Slopes<V>& from, const Slopes<V>& edge) HWY_ATTR {
        return Vec3<V>{hn::Xor(hn::MulSub(edge.v, from.u, hn::Mul(edge.u, from.v)), flip),
                       hn::Xor(hn::Neg(edge.v), flip), hn::Xor(edge.u, flip)};
    };
    EdgeFunctions<V> edges;
    edges.normal[0] = normal(at.b, bc);
    edges.normal[1] = normal(at.c, ca);
    edges.normal[2] = normal(at.a, ab);
    edges.plane = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    edges.volume = hn::Zero(d);
    edges.depth_min = hn::Sub(at.nearest, place_error);
    edges.depth_max = hn::Add(at.farthest, place_error);

    const auto across = [](const Slopes<V>& p) HWY_ATTR { return hn::Add(hn::Abs(p.u), hn::Abs(p.v)); };
    const V edge = hn::Add(across(ab), across(ca));
    const V aside = hn::Max(across(at.a), hn::Max(across(at.b), across(at.c)));
    const V spread = hn::Add(hn::Add(aside, half), hn::Add(edge, edge));
    const V doubt = hn::MulAdd(spread, hn::Set(d, rounding_margin), hn::Add(place_error, place_error));
    // Products of even smaller lengths underflow: nothing is known of their signs.
    const V error = hn::Mul(edge, doubt);
    const auto no_underflow = hn::Ge(error, hn::Set(d, 0x1p-120f));
    edges.error = hn::IfThenElse(no_underflow, error, hn::Inf(d));
    const auto faces = hn::Ge(hn::Abs(area), hn::Mul(at.steepest, hn::Set(d, 0x1p-8f)));
    edges.sure = hn::IfThenElse(faces, hn::Add(edges.error, edges.error), hn::Inf(d));
    return edges;
}

/// Whether a ray has the plane of a triangle behind it, so that `meet_one_ray` finds no hit: with most of a
/// sun's shadow rays and the triangle they start on, which edge functions leave in doubt.
///
/// The depth has the sign of volume over divisor. Each is a sum of products of coordinates and of edges, and
/// seven roundings in a row leave it off by less than `rounding_margin` of the sum of their magnitudes: less
/// than nothing where a wall stands along an axis. A divisor of more than that part of the squared distance
/// has the sign of the sum of edge functions in double, too, whatever those round to.
/// @param a, b, c  relative to the ray's own origin, K not yet along it
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> surely_behind(D d, Vec3<V> a, Vec3<V> b, Vec3<V> c, V sign, const Slopes<V>& slopes) {
    for (Vec3<V>* corner : {&a, &b, &c}) corner->k = hn::Mul(corner->k, sign);
    const Vec3<V> ab = difference(b, a), ac = difference(c, a), n = cross(ab, ac);
    const auto dot = [](const Vec3<V>& p, const Vec3<V>& q)
                         HWY_ATTR { return hn::MulAdd(p.k, q.k, hn::MulAdd(p.u, q.u, hn::Mul(p.v, q.v))); };
    const V volume = dot(a, n), divisor = along(n, slopes);

    const Vec3<V> size_a = magnitudes(a), size_ab = magnitudes(ab), size_ac = magnitudes(ac);
    const auto magnitude = [](V p, V q, V r, V s) HWY_ATTR { return hn::MulAdd(p, q, hn::Mul(r, s)); };
    const Vec3<V> size_n{magnitude(size_ab.u, size_ac.v, size_ab.v, size_ac.u),
                         magnitude(size_ab.v, size_ac.k, size_ab.k, size_ac.v),
                         magnitude(size_ab.k, size_ac.u, size_ab.u, size_ac.k)};
    const V reach = hn::Add(size(a), hn::Add(size(ab), size(ac)));
    const V margin = hn::Set(d, rounding_margin), underflow = hn::Set(d, 0x1p-120f);
    const auto known =
        hn::And(hn::Gt(hn::Abs(volume), hn::MulAdd(dot(size_a, size_n), margin, underflow)),
                hn::Gt(hn::Abs(divisor), hn::MulAdd(hn::Mul(reach, reach), margin, underflow)));
    return hn::And(known, hn::Lt(hn::Xor(volume, hn::And(divisor, hn::SignBit(d))), hn::Zero(d)));
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
