// One ray against a few triangles, one a lane. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_
#undef GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_
#else
#define GRIDREEL_TRAVERSAL_LANE_RAY_INL_H_
#endif

#include "rebuild/triangle_view.h"
#include "traversal/corner_table-inl.h"
#include "traversal/ray_frame.h"
#include "traversal/triangle-inl.h"

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// One ray, which meets up to eight triangles at a time, one a lane.
class LaneRay {
public:
    static constexpr std::size_t width = 8;

    LaneRay(const glm::vec3& origin, const RayFrame& ray) : seen_(origin, ray.axes), ray_(ray) {}

    /// Depths of the hits, wherever on the ray's line, or NaN.
    /// @param count  1 to `width`
    /// @param best   hits behind it may be left out
    void meet_triangles(const rebuild::TriangleView& view, const std::uint32_t* triangles, std::size_t count,
                        float best, float* depths) const {
        const hn::CappedTag<float, width> d;
        CornerTable<width> corners;
        corners.gather(view, triangles, count);
        const auto sign = hn::Set(d, ray_.axes.sign());
        const Slopes<hn::Vec<decltype(d)>> slopes{hn::Set(d, ray_.slope_u), hn::Set(d, ray_.slope_v)};
        for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
            const auto decide = [&](std::size_t lane) {
                const auto point = [&](int which) { return corners.point(which, first + lane, seen_); };
                return meet_in_double(point(0), point(1), point(2), ray_.axes.sign(), ray_.slope_u,
                                      ray_.slope_v);
            };
            const auto met =
                meet_one_ray(d, corners.lanes(d, 0, first, seen_), corners.lanes(d, 1, first, seen_),
                             corners.lanes(d, 2, first, seen_), sign, slopes, hn::Set(d, best), decide);
            hn::StoreU(hn::IfThenElse(met.inside, met.depth, hn::NaN(d)), d, depths + first);
        }
    }

private:
    Viewpoint seen_;
    RayFrame ray_;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
