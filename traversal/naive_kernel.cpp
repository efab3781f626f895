#include "traversal/naive_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/naive_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

DepthHit closest_of_all(const CornerRuns& corners, const glm::vec3& origin, const RayFrame& ray) {
    const hn::CappedTag<float, naive_padding> d;
    const hn::RebindToUnsigned<decltype(d)> du;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    const int axes[3] = {ray.axes.k, ray.axes.u(), ray.axes.v()};

    const V sign = hn::Set(d, ray.axes.sign());
    const Slopes<V> slopes{hn::Set(d, ray.slope_u), hn::Set(d, ray.slope_v)};
    const V depth_min = hn::Set(d, ray.depth_min);
    const auto after = hn::Set(du, ray.after);
    V best = hn::Set(d, ray.depth_max);
    auto best_group = hn::Set(du, no_triangle);

    const auto run = [&](int which, int axis) {
        return corners.data + static_cast<std::size_t>(3 * which + axes[axis]) * corners.padded;
    };
    const auto corner = [&](int which, std::size_t first) {
        V axis[3];
        for (int i = 0; i < 3; ++i)
            axis[i] = hn::Sub(hn::Load(d, run(which, i) + first), hn::Set(d, origin[axes[i]]));
        return Vec3<V>{axis[0], axis[1], axis[2]};
    };
    const auto framed_corner = [&](int which, std::size_t triangle) {
        return FramedPoint{.k = run(which, 0)[triangle] - origin[axes[0]],
                           .u = run(which, 1)[triangle] - origin[axes[1]],
                           .v = run(which, 2)[triangle] - origin[axes[2]]};
    };
    for (std::size_t first = 0; first < corners.count; first += lanes) {
        const auto decide = [&](std::size_t lane) {
            return meet_in_double(framed_corner(0, first + lane), framed_corner(1, first + lane),
                                  framed_corner(2, first + lane), ray.axes.sign(), ray.slope_u, ray.slope_v);
        };
        const auto met =
            meet_one_ray(d, corner(0, first), corner(1, first), corner(2, first), sign, slopes, best, decide);
        const auto index = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(first)));
        const auto begun =
            hn::Or(hn::Gt(met.depth, depth_min),
                   hn::And(hn::Eq(met.depth, depth_min), hn::RebindMask(d, hn::Gt(index, after))));
        const auto closer = hn::And(met.inside, hn::And(begun, hn::Lt(met.depth, best)));
        best = hn::IfThenElse(closer, met.depth, best);
        best_group = hn::IfThenElse(hn::RebindMask(du, closer),
                                    hn::Set(du, static_cast<std::uint32_t>(first)), best_group);
    }

    // Each lane kept its first closest triangle; the lowest index of the closest lanes wins.
    HWY_ALIGN float depths[naive_padding];
    HWY_ALIGN std::uint32_t groups[naive_padding];
    hn::Store(best, d, depths);
    hn::Store(best_group, du, groups);
    DepthHit hit{.depth = ray.depth_max};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (groups[lane] == no_triangle) continue;
        const auto triangle = groups[lane] + static_cast<std::uint32_t>(lane);
        if (depths[lane] < hit.depth || (depths[lane] == hit.depth && triangle < hit.triangle)) {
            hit = {.depth = depths[lane], .triangle = triangle};
        }
    }
    return hit;
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(closest_of_all);

DepthHit closest_of_all(const CornerRuns& corners, const glm::vec3& origin, const RayFrame& ray) {
    return HWY_DYNAMIC_DISPATCH(closest_of_all)(corners, origin, ray);
}

}  // namespace gridreel::traversal
#endif
