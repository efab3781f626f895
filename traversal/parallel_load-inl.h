// From a batch of parallel rays to packets. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PARALLEL_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PARALLEL_LOAD_INL_H_
#undef GRIDREEL_TRAVERSAL_PARALLEL_LOAD_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PARALLEL_LOAD_INL_H_
#endif

#include "rebuild/bounds.h"
#include "rebuild/triangle_view.h"
#include "traversal/framed_lanes-inl.h"
#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/packet_kernel.h"
#include "traversal/packet_load-inl.h"
#include "traversal/rounding.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// What a place in the plane across K may be off by, metres: sixteen roundings of the greatest difference
/// between a coordinate of the packet's origin and one of its rays' origins or of the grid's box
/// (parallel_triangle-inl.h).
inline float place_error(const glm::vec3& origin, const rebuild::Bounds3& grid,
                         const rebuild::Bounds3& rays) {
    double reach = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double at = origin[axis];
        reach = std::max({reach, double(grid.max[axis]) - at, at - double(grid.min[axis]),
                          double(rays.max[axis]) - at, at - double(rays.min[axis])});
    }
    return static_cast<float>(reach) * (2.0f * rounding_margin);
}

/// Sets the packet's origin, and what of its rays is relative to that.
/// @param starts  box of the rays' own origins
/// @param grid    box of all triangles
inline void relate_to_origin(Packet& packet, const rebuild::Bounds3& starts, const rebuild::Bounds3& grid) {
    const LaneTag d;
    const Axes axes = packet.axes;
    packet.origin[axes.k] = axes.negative ? starts.max[axes.k] : starts.min[axes.k];
    packet.origin[axes.u()] = packet.origin_u[0];
    packet.origin[axes.v()] = packet.origin_v[0];
    packet.margin = place_error(packet.origin, grid, starts);
    for (std::size_t lane = 0; lane < packet.block_count() * rays_per_block; lane += hn::Lanes(d)) {
        const auto relative = [&](const float* origins, int axis) HWY_ATTR {
            return hn::Sub(hn::Load(d, origins + lane), hn::Set(d, packet.origin[axis]));
        };
        const Lanes begin = hn::Mul(relative(packet.origin_k, axes.k), hn::Set(d, axes.sign()));
        hn::Store(begin, d, packet.begin + lane);
        hn::Store(
            hn::NegMulAdd(hn::Set(d, packet.common_slope_u), begin, relative(packet.origin_u, axes.u())), d,
            packet.slope_u + lane);
        hn::Store(
            hn::NegMulAdd(hn::Set(d, packet.common_slope_v), begin, relative(packet.origin_v, axes.v())), d,
            packet.slope_v + lane);
    }
}

/// Where the rays at `order[0]` to `order[count - 1]` stand in the batch: a function of the first lane. Lanes
/// behind the last ray repeat it.
HWY_INLINE auto places_in(const std::uint32_t* order, std::size_t count) {
    return [order, count](std::size_t lane) HWY_ATTR {
        const hn::RebindToUnsigned<LaneTag> du;
        if (lane + hn::Lanes(du) <= count) return hn::LoadU(du, order + lane);
        HWY_ALIGN std::uint32_t last[group];
        for (std::size_t i = 0; i < hn::Lanes(du); ++i) last[i] = order[std::min(lane + i, count - 1)];
        return hn::Load(du, last);
    };
}

/// The same for rays [begin, begin + count).
HWY_INLINE auto places_from(std::size_t begin, std::size_t count) {
    return [begin, count](std::size_t lane) HWY_ATTR {
        const hn::RebindToUnsigned<LaneTag> du;
        const auto set = [&](std::size_t value)
                             HWY_ATTR { return hn::Set(du, static_cast<std::uint32_t>(value)); };
        return hn::Add(hn::Min(hn::Add(hn::Iota(du, 0), set(lane)), set(count - 1)), set(begin));
    };
}

/// Fills the packet with rays of a batch with a common direction, unless one of them can hit nothing.
/// @param count     1 to `rays_per_packet`
/// @param places    `places(lane)`: where in the batch the rays of as many lanes stand, from `lane` on;
///                  lanes behind the last ray repeat it
/// @return whether all can hit something
template <class PlacesOf>
[[nodiscard]] HWY_INLINE bool load_parallel(const PacketSource& source, const rebuild::Bounds3& grid,
                                            std::size_t count, const PlacesOf& places, Packet& packet) {
    assert(count >= 1 && count <= rays_per_packet);
    const LaneTag d;
    const hn::RebindToUnsigned<LaneTag> du;
    const hn::RebindToSigned<LaneTag> di;
    const RayBatch& rays = source.rays;
    const RayFrame frame = frame_of_parallel(rays);
    packet.axes = frame.axes;
    packet.common_slope_u = frame.slope_u;
    packet.common_slope_v = frame.slope_v;
    packet.ray_count = static_cast<std::uint32_t>(count);

    const std::array<int, 3> axes{frame.axes.k, frame.axes.u(), frame.axes.v()};
    const std::array<float*, 3> origins{packet.origin_k, packet.origin_u, packet.origin_v};
    const Lanes depth_per_t = hn::Set(d, frame.depth_per_t);
    const Lanes largest = hn::Set(d, rebuild::largest_coordinate);
    Lanes low[3] = {largest, largest, largest};
    Lanes high[3] = {hn::Neg(largest), hn::Neg(largest), hn::Neg(largest)};
    for (std::size_t lane = 0; lane < packet.block_count() * rays_per_block; lane += hn::Lanes(d)) {
        const auto place = places(lane);
        hn::Store(place, du, packet.ray + lane);
        const auto read = [&](const rebuild::Buffer<float>& values)
                              HWY_ATTR { return hn::GatherIndex(d, values.data(), hn::BitCast(di, place)); };
        const ParallelLanes lanes = parallel_lanes(rays, frame, read);
        if (!hn::AllTrue(d, lanes.alive)) return false;
        const Lanes starts_at[3] = {lanes.k, lanes.u, lanes.v};
        for (std::size_t i = 0; i < 3; ++i) {
            low[i] = hn::Min(low[i], starts_at[i]);
            high[i] = hn::Max(high[i], starts_at[i]);
            hn::Store(starts_at[i], d, origins[i] + lane);
        }
        hn::Store(lanes.depth_min, d, packet.depth_min + lane);
        hn::Store(lanes.depth_max, d, packet.depth_max + lane);
        hn::Store(depth_per_t, d, packet.depth_per_t + lane);
    }
    rebuild::Bounds3 starts;
    for (std::size_t i = 0; i < 3; ++i) {
        starts.min[axes[i]] = hn::GetLane(hn::MinOfLanes(d, low[i]));
        starts.max[axes[i]] = hn::GetLane(hn::MaxOfLanes(d, high[i]));
    }
    relate_to_origin(packet, starts, grid);
    finish_loading<Bundle::parallel>(source, packet);
    return true;
}

/// Rays at `order[0]` to `order[count - 1]` of the batch.
[[nodiscard]] HWY_INLINE bool load_parallel_chosen(const PacketSource& source, const rebuild::Bounds3& grid,
                                                   const std::uint32_t* order, std::size_t count,
                                                   Packet& packet) {
    return load_parallel(source, grid, count, places_in(order, count), packet);
}

/// Rays [begin, begin + count) of the batch.
[[nodiscard]] HWY_INLINE bool load_parallel_run(const PacketSource& source, const rebuild::Bounds3& grid,
                                                std::size_t begin, std::size_t count, Packet& packet) {
    return load_parallel(source, grid, count, places_from(begin, count), packet);
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
