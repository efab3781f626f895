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
#include "traversal/transpose-inl.h"
#include "traversal/triangle-inl.h"

#include <algorithm>
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
    /// @param count   1 to `width`
    /// @param best    hits behind it may be left out
    /// @param depths  room for `width`
    /// @return a bit for each triangle that is hit
    HWY_INLINE unsigned meet_triangles(const rebuild::TriangleView& view, const std::uint32_t* triangles,
                                       std::size_t count, float best, float* depths) const {
        const hn::CappedTag<float, width> d;
        const rebuild::HWY_NAMESPACE::PositionReader positions(view.positions);
        const auto sign = hn::Set(d, ray_.axes.sign());
        const Slopes<hn::Vec<decltype(d)>> slopes{hn::Set(d, ray_.slope_u), hn::Set(d, ray_.slope_v)};
        unsigned met_bits = 0;
        for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
            glm::uvec3 indices[width];  // the last triangle fills what is left
            for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
                indices[i] = view.triangles[triangles[std::min(first + i, count - 1)]];
            }
            const auto decide = [&](std::size_t lane) {
                const auto point = [&](int which) {
                    const glm::vec3& p = view.positions[indices[lane][which]];
                    const auto along = [&](std::size_t i) {
                        return p[seen_.axes[i]] - seen_.origin[seen_.axes[i]];
                    };
                    return FramedPoint{.k = along(0), .u = along(1), .v = along(2)};
                };
                return meet_in_double(point(0), point(1), point(2), ray_.axes.sign(), ray_.slope_u,
                                      ray_.slope_v);
            };
            const auto met =
                meet_one_ray(d, corners(d, positions, indices, 0), corners(d, positions, indices, 1),
                             corners(d, positions, indices, 2), sign, slopes, hn::Set(d, best), decide);
            hn::StoreU(hn::IfThenElse(met.inside, met.depth, hn::NaN(d)), d, depths + first);
            if (HWY_LIKELY(hn::AllFalse(d, met.inside))) continue;
            std::uint8_t bits[8] = {};
            hn::StoreMaskBits(d, met.inside, bits);
            met_bits |= static_cast<unsigned>(bits[0]) << first;
        }
        return met_bits & ((1u << count) - 1);
    }

private:
    /// One corner of as many triangles as there are lanes. Positions are transposed in registers: reading
    /// whole what was just written in parts would wait for the parts.
    template <class D, class V = hn::Vec<D>>
    HWY_INLINE Vec3<V> corners(D d, const rebuild::HWY_NAMESPACE::PositionReader& positions,
                               const glm::uvec3* indices, int which) const {
        const auto row = [&](std::size_t i) HWY_ATTR { return positions.at(indices[i][which]); };
        V axis[3];
        transpose_rows(d, row, axis);
        const auto along = [&](std::size_t i) HWY_ATTR {
            return hn::Sub(axis[seen_.axes[i]], hn::Set(d, seen_.origin[seen_.axes[i]]));
        };
        return {along(0), along(1), along(2)};
    }

    Viewpoint seen_;
    RayFrame ray_;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
