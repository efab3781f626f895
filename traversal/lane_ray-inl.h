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

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// One ray, which meets up to eight triangles at a time, one a lane.
class LaneRay {
public:
    static constexpr std::size_t width = 8;

    LaneRay(const glm::vec3& origin, const RayFrame& ray)
        : origin_(origin), ray_(ray), axes_{ray.axes.k, ray.axes.u(), ray.axes.v()} {}

    /// Depths of the hits, wherever on the ray's line, or NaN.
    /// @param count  1 to `width`
    /// @param best   hits behind it may be left out
    void meet_triangles(const rebuild::TriangleView& view, const std::uint32_t* triangles, std::size_t count,
                        float best, float* depths) const {
        const Tag d;
        HWY_ALIGN float corners[3][width][4];
        gather(view, triangles, count, corners);
        for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
            const auto corner = [&](int which) {
                Vec axis[3], unused;
                hn::LoadInterleaved4(d, corners[which][first], axis[0], axis[1], axis[2], unused);
                const auto along = [&](int i) {
                    return hn::Sub(axis[axes_[std::size_t(i)]], hn::Set(d, origin_[axes_[std::size_t(i)]]));
                };
                return Vec3<Vec>{along(0), along(1), along(2)};
            };
            const auto decide = [&](std::size_t lane) {
                const auto point = [&](int which) { return in_frame(corners[which][first + lane]); };
                return meet_in_double(point(0), point(1), point(2), ray_.axes.sign(), ray_.slope_u,
                                      ray_.slope_v);
            };
            const auto edges =
                edge_functions(d, corner(0), corner(1), corner(2), hn::Set(d, ray_.axes.sign()));
            const auto met =
                meet(d, edges, hn::Set(d, ray_.slope_u), hn::Set(d, ray_.slope_v), hn::Set(d, best), decide);
            hn::StoreU(hn::IfThenElse(met.inside, met.depth, hn::NaN(d)), d, depths + first);
        }
    }

private:
    using Tag = hn::CappedTag<float, width>;
    using Vec = hn::Vec<Tag>;

    /// Copies corners as they stand in memory; the last triangle fills what is left.
    static void gather(const rebuild::TriangleView& view, const std::uint32_t* triangles, std::size_t count,
                       float (&corners)[3][width][4]) {
        const hn::FixedTag<float, 4> four;
        const auto last_vertex = static_cast<std::uint32_t>(view.positions.size() - 1);
        for (std::size_t i = 0; i < width; ++i) {
            const glm::uvec3& indices = view.triangles[triangles[std::min(i, count - 1)]];
            for (int which = 0; which < 3; ++which) {
                copy_position(four, view.positions, indices[which], last_vertex, corners[which][i]);
            }
        }
    }

    [[nodiscard]] FramedPoint in_frame(const float* p) const {
        const auto along = [&](std::size_t i) { return p[axes_[i]] - origin_[axes_[i]]; };
        return {.k = along(0), .u = along(1), .v = along(2)};
    }

    glm::vec3 origin_;
    RayFrame ray_;
    std::array<int, 3> axes_;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
