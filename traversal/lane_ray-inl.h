// One ray against one triangle, one lane wide. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_
#undef GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_
#else
#define GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_
#endif

#include "rebuild/triangle_view.h"
#include "traversal/ray_frame.h"
#include "traversal/triangle-inl.h"

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// One ray in the form the lane kernel wants it.
class LaneRay {
public:
    LaneRay(const glm::vec3& origin, const RayFrame& ray)
        : origin_(origin), ray_(ray), axes_{ray.axes.k, ray.axes.u(), ray.axes.v()} {}

    /// Depth of the hit, wherever on the ray's line, or NaN.
    [[nodiscard]] float meet_triangle(const rebuild::TriangleView& triangles, std::uint32_t triangle) const {
        const glm::uvec3& indices = triangles.triangles[triangle];
        const FramedPoint a = corner(triangles.positions[indices.x]);
        const FramedPoint b = corner(triangles.positions[indices.y]);
        const FramedPoint c = corner(triangles.positions[indices.z]);
        const auto edges =
            edge_functions(lane, in_lane(a), in_lane(b), in_lane(c), hn::Set(lane, ray_.axes.sign()));
        const auto met =
            meet(lane, edges, hn::Set(lane, ray_.slope_u), hn::Set(lane, ray_.slope_v), hn::Inf(lane),
                 [&](std::size_t) {
                     return meet_in_double(a, b, c, ray_.axes.sign(), ray_.slope_u, ray_.slope_v);
                 });
        return hn::GetLane(hn::IfThenElse(met.inside, met.depth, hn::NaN(lane)));
    }

private:
    static constexpr hn::CappedTag<float, 1> lane{};
    using V = hn::Vec<hn::CappedTag<float, 1>>;

    [[nodiscard]] FramedPoint corner(const glm::vec3& p) const {
        return {.k = p[axes_[0]] - origin_[axes_[0]],
                .u = p[axes_[1]] - origin_[axes_[1]],
                .v = p[axes_[2]] - origin_[axes_[2]]};
    }

    [[nodiscard]] static Vec3<V> in_lane(const FramedPoint& p) {
        return {hn::Set(lane, p.k), hn::Set(lane, p.u), hn::Set(lane, p.v)};
    }

    glm::vec3 origin_;
    RayFrame ray_;
    std::array<int, 3> axes_;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
