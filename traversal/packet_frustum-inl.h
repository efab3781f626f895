// What the rays of some blocks of a packet lie in. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PACKET_FRUSTUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PACKET_FRUSTUM_INL_H_
#undef GRIDREEL_TRAVERSAL_PACKET_FRUSTUM_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PACKET_FRUSTUM_INL_H_
#endif

#include "traversal/block_boxes-inl.h"
#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/triangle-inl.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

struct Interval {
    double low, high;
};

/// Where rays can be across, along one axis: at depth s from low + s * low_slope to high + s * high_slope.
struct Sweep {
    double low, high, low_slope, high_slope;

    [[nodiscard]] Interval between(double from, double to) const {
        return {low + std::min(from * low_slope, to * low_slope),
                high + std::max(from * high_slope, to * high_slope)};
    }
};

/// What the rays of some blocks lie in, and the blocks as triangles are held against them.
struct Frustum : Hull {
    std::optional<BlockBoxes> boxes;  ///< since there were triangles
};

/// What all rays of loose blocks lie in: places between two lines along either axis.
struct LooseFrustum {
    Sweep u, v;
    float near_depth = 0.0f, far_depth = -1.0f;
};

template <Bundle bundle>
using FrustumOf = std::conditional_t<bundle == Bundle::loose, LooseFrustum, Frustum>;

HWY_INLINE Frustum frustum_of_slopes(const Packet& packet, BlockMask active) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    float low_u = infinity, high_u = -infinity, low_v = infinity, high_v = -infinity;
    Frustum hull;
    hull.near_depth = packet.near_depth[std::countr_zero(active)];
    for (BlockMask rest = active; rest != 0; rest &= rest - 1) {
        const int block = std::countr_zero(rest);
        low_u = std::min(low_u, packet.centre_u[block] - packet.half_u[block]);
        high_u = std::max(high_u, packet.centre_u[block] + packet.half_u[block]);
        low_v = std::min(low_v, packet.centre_v[block] - packet.half_v[block]);
        high_v = std::max(high_v, packet.centre_v[block] + packet.half_v[block]);
        hull.near_depth = std::min(hull.near_depth, packet.near_depth[block]);
        hull.far_depth = std::max(hull.far_depth, packet.far_depth[block]);
    }
    hull.centre_u = 0.5f * (low_u + high_u);
    hull.centre_v = 0.5f * (low_v + high_v);
    hull.half_u = std::max(high_u - hull.centre_u, hull.centre_u - low_u) + packet.margin;
    hull.half_v = std::max(high_v - hull.centre_v, hull.centre_v - low_v) + packet.margin;
    return hull;
}

/// Between the near and the far plane the hull of some blocks' bounds is interpolated, as each block's own.
HWY_INLINE LooseFrustum loose_frustum_of(const Packet& packet, BlockMask active) {
    LooseFrustum hull;
    hull.near_depth = packet.near_depth[std::countr_zero(active)];
    for (BlockMask rest = active; rest != 0; rest &= rest - 1) {
        const int block = std::countr_zero(rest);
        hull.near_depth = std::min(hull.near_depth, packet.near_depth[block]);
        hull.far_depth = std::max(hull.far_depth, packet.far_depth[block]);
    }
    const auto sweep = [&](const float* centre, const float* half, const float* turn, const float* spread) {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const float way = packet.far_plane - packet.near_plane;
        float near_low = infinity, near_high = -infinity, far_low = infinity, far_high = -infinity;
        for (BlockMask rest = active; rest != 0; rest &= rest - 1) {
            const int block = std::countr_zero(rest);
            near_low = std::min(near_low, centre[block] - half[block]);
            near_high = std::max(near_high, centre[block] + half[block]);
            const float far_centre = centre[block] + way * turn[block];
            const float far_half = half[block] + way * spread[block];
            far_low = std::min(far_low, far_centre - far_half);
            far_high = std::max(far_high, far_centre + far_half);
        }
        const double low_slope = (double(far_low) - double(near_low)) / double(way);
        const double high_slope = (double(far_high) - double(near_high)) / double(way);
        return Sweep{.low = double(near_low) - double(packet.near_plane) * low_slope,
                     .high = double(near_high) - double(packet.near_plane) * high_slope,
                     .low_slope = low_slope,
                     .high_slope = high_slope};
    };
    hull.u = sweep(packet.centre_u, packet.half_u, packet.turn_u, packet.spread_u);
    hull.v = sweep(packet.centre_v, packet.half_v, packet.turn_v, packet.spread_v);
    return hull;
}

/// Where the frustum's rays are across.
struct Sweeps {
    Sweep u, v;
};

/// @param corner_error  metres by which corners may stand beside their cells
template <Bundle bundle>
HWY_INLINE Sweeps sweeps_of(const Packet& packet, const FrustumOf<bundle>& frustum, double corner_error) {
    if constexpr (bundle == Bundle::loose) {
        return {frustum.u, frustum.v};
    } else {
        const auto sweep = [&](float centre, float half, const float& common_slope) {
            const double low = double(centre) - double(half), high = double(centre) + double(half);
            return bundle == Bundle::parallel
                       ? Sweep{low - corner_error, high + corner_error, common_slope, common_slope}
                       : Sweep{-corner_error, corner_error, low, high};
        };
        return {sweep(frustum.centre_u, frustum.half_u, packet.common_slope_u),
                sweep(frustum.centre_v, frustum.half_v, packet.common_slope_v)};
    }
}

template <Bundle bundle>
HWY_INLINE FrustumOf<bundle> frustum_of(const Packet& packet, BlockMask active) {
    if constexpr (bundle == Bundle::loose) {
        return loose_frustum_of(packet, active);
    } else {
        return frustum_of_slopes(packet, active);
    }
}

/// The active blocks on the lower side of the middle of the frustum's wider side.
/// @param depth  where loose rays are divided
template <Bundle bundle>
BlockMask lower_half(const Packet& packet, BlockMask active, const FrustumOf<bundle>& frustum, double depth) {
    bool by_u = false;
    float middle = 0.0f, way = 0.0f;
    if constexpr (bundle == Bundle::loose) {
        const Interval u = frustum.u.between(depth, depth), v = frustum.v.between(depth, depth);
        by_u = u.high - u.low > v.high - v.low;
        middle = static_cast<float>(0.5 * (by_u ? u.low + u.high : v.low + v.high));
        way = std::clamp(static_cast<float>(depth), packet.near_plane, packet.far_plane) - packet.near_plane;
    } else {
        by_u = frustum.half_u > frustum.half_v;
        middle = by_u ? frustum.centre_u : frustum.centre_v;
    }
    const float* const centre = by_u ? packet.centre_u : packet.centre_v;
    const float* const turn = by_u ? packet.turn_u : packet.turn_v;
    BlockMask lower = 0;
    for (BlockMask rest = active; rest != 0; rest &= rest - 1) {
        const int block = std::countr_zero(rest);
        const float at = bundle == Bundle::loose ? centre[block] + way * turn[block] : centre[block];
        if (at < middle) lower |= BlockMask{1} << block;
    }
    return lower;
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
