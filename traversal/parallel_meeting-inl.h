// A triangle against some parallel rays of a packet, a ray a lane. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PARALLEL_MEETING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PARALLEL_MEETING_INL_H_
#undef GRIDREEL_TRAVERSAL_PARALLEL_MEETING_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PARALLEL_MEETING_INL_H_
#endif

#include "traversal/corner_table-inl.h"
#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/parallel_triangle-inl.h"
#include "traversal/triangle-inl.h"

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Where parallel rays meet a triangle: those in the lanes from `first` on. The edge functions only say which
/// rays come near: those are asked one by one, a ray a lane, so that the answer has the same bits as a lone
/// ray's. Of any hit the depth does not matter, as long as it is one between the ray's limits.
/// @param corners  the triangle's are at `place`
template <Wanted wanted>
HWY_INLINE Meeting<LaneTag> meet_parallel(const Packet& packet, const Slopes<Lanes>& aim,
                                          const EdgeFunctions<Lanes>& edges,
                                          const CornerTable<group>& corners, std::size_t place,
                                          std::size_t first) {
    // Rays that come near.
    const LaneTag d;
    const Lanes best = hn::Load(d, packet.depth + first);
    const Lanes depth_min = hn::Load(d, packet.depth_min + first);
    const Lanes begin = hn::Load(d, packet.begin + first);
    const Slopes<Lanes> places{hn::Load(d, packet.slope_u + first), hn::Load(d, packet.slope_v + first)};
    const Lanes least = least_edge(edges, difference(places, aim));
    const Lanes nearest = hn::Sub(edges.depth_min, begin), farthest = hn::Sub(edges.depth_max, begin);
    const auto in_reach =
        hn::And(hn::And(hn::Le(nearest, best), hn::Ge(farthest, depth_min)), hn::Gt(best, hn::Zero(d)));
    auto asked = hn::And(in_reach, hn::Ge(least, hn::Neg(edges.error)));
    if (hn::AllFalse(d, asked)) return {asked, best};

    // Rays that any hit will do for.
    auto sure = hn::FirstN(d, 0);
    if (wanted == Wanted::any) {
        sure = hn::And(hn::And(asked, hn::Gt(least, edges.sure)),
                       hn::And(hn::Gt(nearest, depth_min), hn::Lt(farthest, best)));
        asked = hn::AndNot(sure, asked);
        if (hn::AllFalse(d, asked)) return {sure, nearest};
    }

    // Rays that begin beyond the triangle.
    const Axes axes = packet.axes;
    const auto corner = [&](int which) HWY_ATTR {
        const float* p = corners.corner[which][place];
        return Vec3<Lanes>{hn::Sub(hn::Set(d, p[axes.k]), hn::Load(d, packet.origin_k + first)),
                           hn::Sub(hn::Set(d, p[axes.u()]), hn::Load(d, packet.origin_u + first)),
                           hn::Sub(hn::Set(d, p[axes.v()]), hn::Load(d, packet.origin_v + first))};
    };
    const Vec3<Lanes> a = corner(0), b = corner(1), c = corner(2);
    const Lanes sign = hn::Set(d, axes.sign());
    const Slopes<Lanes> slopes{hn::Set(d, packet.common_slope_u), hn::Set(d, packet.common_slope_v)};
    asked = hn::AndNot(surely_behind(d, a, b, c, sign, slopes), asked);
    if (hn::AllFalse(d, asked)) return {sure, nearest};

    // The others, each as if alone.
    const auto decide = [&](std::size_t lane) {
        const auto point = [&](int which) {
            const float* p = corners.corner[which][place];
            return FramedPoint{.k = p[axes.k] - packet.origin_k[first + lane],
                               .u = p[axes.u()] - packet.origin_u[first + lane],
                               .v = p[axes.v()] - packet.origin_v[first + lane]};
        };
        return meet_in_double(point(0), point(1), point(2), axes.sign(), packet.common_slope_u,
                              packet.common_slope_v);
    };
    const Lanes best_of_asked = hn::IfThenElse(asked, best, hn::Neg(hn::Inf(d)));
    const auto met = meet_one_ray(d, a, b, c, sign, slopes, best_of_asked, decide);
    return {hn::Or(sure, met.inside), hn::IfThenElse(sure, nearest, met.depth)};
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
