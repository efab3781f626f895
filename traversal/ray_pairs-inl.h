// Rays and triangles that may meet, each lane a pair of its own. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_RAY_PAIRS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_RAY_PAIRS_INL_H_
#undef GRIDREEL_TRAVERSAL_RAY_PAIRS_INL_H_
#else
#define GRIDREEL_TRAVERSAL_RAY_PAIRS_INL_H_
#endif

#include "rebuild/read_position-inl.h"
#include "rebuild/triangle_view.h"
#include "traversal/cell_pieces-inl.h"
#include "traversal/ray_frame.h"
#include "traversal/transpose-inl.h"
#include "traversal/triangle-inl.h"

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include <glm/vec3.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A ray as pairs see it.
struct PairedRay {
    alignas(16) float origin[4]{};       ///< on the ray's K, U, V
    alignas(16) std::int32_t axes[4]{};  ///< K, U, V
    alignas(16) float slopes[4]{};       ///< U, V, and the ray's sign along K

    PairedRay() = default;
    PairedRay(const glm::vec3& from, const RayFrame& ray)
        : axes{ray.axes.k, ray.axes.u(), ray.axes.v(), 3},
          slopes{ray.slope_u, ray.slope_v, ray.axes.sign(), 0.0f} {
        for (int i = 0; i < 3; ++i) origin[i] = from[axes[i]];
    }
};

/// Pairs that wait to be intersected.
class RayPairs {
public:
    static constexpr std::size_t capacity = 256;

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool has_room(std::size_t pairs) const { return count_ + pairs <= capacity; }

    /// Adds one stream's pairs with those of `triangles` that have their bit set. There is room.
    HWY_INLINE void add(const std::uint32_t* triangles, unsigned bits, std::uint32_t stream) {
        const hn::CappedTag<std::uint32_t, boxes_at_a_time> d;
        const std::uint8_t mask[8] = {static_cast<std::uint8_t>(bits)};
        hn::StoreU(hn::CompressBits(hn::LoadU(d, triangles), mask), d, triangle_ + count_);
        hn::StoreU(hn::Set(d, stream), d, stream_ + count_);
        count_ += static_cast<std::size_t>(std::popcount(bits));
    }

    /// Lets go of pairs unless `wanted(stream, triangle)`.
    template <class Wanted>
    HWY_INLINE void keep(const Wanted& wanted) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const std::uint32_t triangle = triangle_[i], stream = stream_[i];
            triangle_[kept] = triangle;
            stream_[kept] = stream;
            kept += wanted(stream, triangle) ? 1 : 0;
        }
        count_ = kept;
    }

    /// Intersects all pairs, and lets go of them.
    /// @param rays  by stream
    /// @param best  by stream: hits behind it may be left out
    /// @param meet  `meet(stream, triangle, depth)` for each hit, wherever on the ray's line
    template <class Meet>
    HWY_INLINE void meet_all(const rebuild::TriangleView& view, const PairedRay* rays, const float* best,
                             const Meet& meet) {
        const D d;
        // The last pair fills what is left.
        for (std::size_t i = count_; i < count_ + width; ++i) {
            triangle_[i] = triangle_[count_ - 1];
            stream_[i] = stream_[count_ - 1];
        }
        for (std::size_t i = 0; i < count_; ++i) hwy::Prefetch(&view.triangles[triangle_[i]]);
        for (std::size_t i = 0; i < count_; ++i) {
            const glm::uvec3& corners = view.triangles[triangle_[i]];
            for (int which = 0; which < 3; ++which) hwy::Prefetch(&view.positions[corners[which]]);
        }
        for (std::size_t first = 0; first < count_; first += hn::Lanes(d)) {
            HWY_ALIGN float depths[width];
            unsigned met = meet_lanes(view, rays, best, first, depths);
            if (count_ - first < hn::Lanes(d)) met &= (1u << (count_ - first)) - 1;
            for (; met != 0; met &= met - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(met));
                meet(stream_[first + i], triangle_[first + i], depths[i]);
            }
        }
        count_ = 0;
    }

private:
    static constexpr std::size_t width = 8;
    using D = hn::CappedTag<float, width>;
    using V = hn::Vec<D>;

    HWY_INLINE unsigned meet_lanes(const rebuild::TriangleView& view, const PairedRay* rays,
                                   const float* best, std::size_t first, float* depths) const {
        const D d;
        const hn::FixedTag<float, 4> four;
        const rebuild::HWY_NAMESPACE::PositionReader positions(view.positions);
        const std::uint32_t* const stream = stream_ + first;
        glm::uvec3 indices[width];
        for (std::size_t i = 0; i < hn::Lanes(d); ++i) indices[i] = view.triangles[triangle_[first + i]];
        const auto transposed = [&](const auto& row) HWY_ATTR {
            V column[3];
            transpose_rows(d, row, column);
            return Vec3<V>{column[0], column[1], column[2]};
        };
        const auto corners = [&](int which) HWY_ATTR {
            return transposed([&](std::size_t i) HWY_ATTR {
                const PairedRay& ray = rays[stream[i]];
                const auto axes =
                    hn::IndicesFromVec(four, hn::Load(hn::FixedTag<std::int32_t, 4>(), ray.axes));
                return hn::Sub(hn::TableLookupLanes(positions.at(indices[i][which]), axes),
                               hn::Load(four, ray.origin));
            });
        };
        const Vec3<V> seen =
            transposed([&](std::size_t i) HWY_ATTR { return hn::Load(four, rays[stream[i]].slopes); });
        const auto decide = [&](std::size_t lane) {
            const PairedRay& ray = rays[stream[lane]];
            const auto point = [&](int which) {
                const glm::vec3& p = view.positions[indices[lane][which]];
                return FramedPoint{.k = p[ray.axes[0]] - ray.origin[0],
                                   .u = p[ray.axes[1]] - ray.origin[1],
                                   .v = p[ray.axes[2]] - ray.origin[2]};
            };
            return meet_in_double(point(0), point(1), point(2), ray.slopes[2], ray.slopes[0], ray.slopes[1]);
        };
        const auto best_of = hn::GatherIndex(
            d, best, hn::BitCast(hn::RebindToSigned<D>(), hn::LoadU(hn::RebindToUnsigned<D>(), stream)));
        const auto met = meet_one_ray(d, corners(0), corners(1), corners(2), seen.v,
                                      Slopes<V>{seen.k, seen.u}, best_of, decide);
        hn::Store(met.depth, d, depths);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(d, met.inside, bits);
        return bits[0];
    }

    std::size_t count_ = 0;
    std::uint32_t triangle_[capacity + width], stream_[capacity + width];
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
