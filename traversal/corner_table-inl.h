// Corners of a few triangles, from scattered vertices to lanes. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_CORNER_TABLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_CORNER_TABLE_INL_H_
#undef GRIDREEL_TRAVERSAL_CORNER_TABLE_INL_H_
#else
#define GRIDREEL_TRAVERSAL_CORNER_TABLE_INL_H_
#endif

#include "rebuild/read_position-inl.h"
#include "rebuild/triangle_view.h"
#include "traversal/ray_frame.h"
#include "traversal/triangle-inl.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Where rays start and how their axes run: what turns a position into a `FramedPoint`.
struct Viewpoint {
    glm::vec3 origin;
    std::array<int, 3> axes;  ///< K, U, V

    Viewpoint(const glm::vec3& from, Axes along) : origin(from), axes{along.k, along.u(), along.v()} {}
};

/// The corners of up to `width` triangles as they stand in memory, four floats each, the fourth meaningless.
template <std::size_t width>
struct alignas(64) CornerTable {
    float corner[3][width][4];

    /// Copies the corners of 1 to `width` triangles; the last triangle fills what is left.
    HWY_INLINE void gather(const rebuild::TriangleView& view, const std::uint32_t* triangles,
                           std::size_t count) {
        const rebuild::HWY_NAMESPACE::PositionReader positions(view.positions);
        for (std::size_t i = 0; i < width; ++i) {
            const glm::uvec3& indices = view.triangles[triangles[std::min(i, count - 1)]];
            for (int which = 0; which < 3; ++which) {
                hn::Store(positions.at(indices[which]), rebuild::HWY_NAMESPACE::FourTag(), corner[which][i]);
            }
        }
    }

    /// One corner of the triangles from `first` on, a triangle a lane.
    template <class D, class V = hn::Vec<D>>
    [[nodiscard]] HWY_INLINE Vec3<V> lanes(D d, int which, std::size_t first, const Viewpoint& seen) const {
        V axis[3], unused;
        hn::LoadInterleaved4(d, corner[which][first], axis[0], axis[1], axis[2], unused);
        const auto along = [&](std::size_t i) {
            return hn::Sub(axis[seen.axes[i]], hn::Set(d, seen.origin[seen.axes[i]]));
        };
        return {along(0), along(1), along(2)};
    }

    /// One corner of one triangle.
    [[nodiscard]] FramedPoint point(int which, std::size_t triangle, const Viewpoint& seen) const {
        const float* p = corner[which][triangle];
        const auto along = [&](std::size_t i) { return p[seen.axes[i]] - seen.origin[seen.axes[i]]; };
        return {.k = along(0), .u = along(1), .v = along(2)};
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
