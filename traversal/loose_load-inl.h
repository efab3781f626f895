// From a batch of rays with nothing in common to packets of those that run nearly the same way. Included once
// per SIMD target.
//
// As Wald et al. 2006 bound a camera's packet by slopes, and Boulos et al. 2007 secondary packets by
// intervals of origins and directions, rays are bounded by their places across at two planes.
//
// Let e be 2^-24 and R the greatest difference between a coordinate of the packet's origin and one of a ray's
// origin or of the grid's box. The place of a ray at a plane is off by 9 e R: by e R for its origin, by 3 e R
// for the depth from there, rounded twice and times a slope of at most 1, and by 5 e R for the sum of at most
// 3 R (one rounding with fused multiply-add, two without). A lone ray sees corners off by 4 e R across. A
// corner less the middle of some rays is off by 14 e R, half their width there by 8 e R. That is 35 e R;
// bounds are widened by four times `place_error`, 64 e R.

#if defined(GRIDREEL_TRAVERSAL_LOOSE_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_LOOSE_LOAD_INL_H_
#undef GRIDREEL_TRAVERSAL_LOOSE_LOAD_INL_H_
#else
#define GRIDREEL_TRAVERSAL_LOOSE_LOAD_INL_H_
#endif

#include "rebuild/bounds.h"
#include "rebuild/triangle_view.h"
#include "traversal/framed_lanes-inl.h"
#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/packet_kernel.h"
#include "traversal/packet_load-inl.h"
#include "traversal/parallel_depths-inl.h"
#include "traversal/parallel_load-inl.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Least and greatest place of a block's rays at a depth.
struct PlaceBox {
    float low_u, high_u, low_v, high_v;
};

HWY_INLINE PlaceBox places_of_block(const Packet& packet, std::size_t block, float depth) {
    const LaneTag d;
    const Axes axes = packet.axes;
    Lanes low_u = hn::Inf(d), high_u = hn::Neg(hn::Inf(d)), low_v = low_u, high_v = high_u;
    for (std::size_t i = 0; i < rays_per_block; i += hn::Lanes(d)) {
        const std::size_t lane = block * rays_per_block + i;
        const Lanes way = hn::Sub(hn::Set(d, depth), hn::Load(d, packet.begin + lane));
        const auto place = [&](const float* origins, const float* slopes, int axis) HWY_ATTR {
            return hn::MulAdd(way, hn::Load(d, slopes + lane),
                              hn::Sub(hn::Load(d, origins + lane), hn::Set(d, packet.origin[axis])));
        };
        const Lanes u = place(packet.origin_u, packet.slope_u, axes.u());
        const Lanes v = place(packet.origin_v, packet.slope_v, axes.v());
        low_u = hn::Min(low_u, u);
        high_u = hn::Max(high_u, u);
        low_v = hn::Min(low_v, v);
        high_v = hn::Max(high_v, v);
    }
    return {hn::GetLane(hn::MinOfLanes(d, low_u)), hn::GetLane(hn::MaxOfLanes(d, high_u)),
            hn::GetLane(hn::MinOfLanes(d, low_v)), hn::GetLane(hn::MaxOfLanes(d, high_v))};
}

/// Where the planes stand at least apart, as a part of R, so that rounding turns no line between them.
constexpr float least_way = 0x1p-8f;

/// Sets the planes between which the packet's rays can hit anything, and where each block's rays are there.
/// In between, the greatest of their places is no greater than along the straight line from the one bound to
/// the other: it is a maximum of linear functions of depth, which is convex. Beyond, it may be.
inline void bound_loose(Packet& packet, const rebuild::Bounds3& grid) {
    const Axes axes = packet.axes;
    const std::size_t count = packet.block_count();
    float near = packet.near_depth[0], far = packet.far_depth[0];
    for (std::size_t block = 1; block < count; ++block) {
        near = std::min(near, packet.near_depth[block]);
        far = std::max(far, packet.far_depth[block]);
    }
    const float entry = axes.sign() * ((axes.negative ? grid.max : grid.min)[axes.k] - packet.origin[axes.k]);
    const float exit = axes.sign() * ((axes.negative ? grid.min : grid.max)[axes.k] - packet.origin[axes.k]);
    packet.near_plane = std::min(std::max(near, entry - packet.margin), exit + packet.margin);
    const float reach = packet.margin * (1.0f / (2.0f * rounding_margin));
    const float least = std::max(reach * least_way, std::numeric_limits<float>::min());  // a point's grid
    packet.far_plane = std::max(std::min(far, exit + packet.margin), packet.near_plane + least);
    const float per_depth = 1.0f / (packet.far_plane - packet.near_plane);
    const float margin = 4.0f * packet.margin;
    for (std::size_t block = 0; block < blocks_per_packet; ++block) {
        if (block >= count) {
            packet.turn_u[block] = packet.turn_v[block] = packet.spread_u[block] = packet.spread_v[block] =
                0.0f;
            continue;
        }
        const PlaceBox at_near = places_of_block(packet, block, packet.near_plane);
        const PlaceBox at_far = places_of_block(packet, block, packet.far_plane);
        const auto bound = [&](float near_low, float near_high, float far_low, float far_high, float& centre,
                               float& half, float& turn, float& spread) {
            centre = 0.5f * (near_low + near_high);
            half = 0.5f * (near_high - near_low) + margin;
            turn = (0.5f * (far_low + far_high) - centre) * per_depth;
            spread = (0.5f * (far_high - far_low) + margin - half) * per_depth;
        };
        bound(at_near.low_u, at_near.high_u, at_far.low_u, at_far.high_u, packet.centre_u[block],
              packet.half_u[block], packet.turn_u[block], packet.spread_u[block]);
        bound(at_near.low_v, at_near.high_v, at_far.low_v, at_far.high_v, packet.centre_v[block],
              packet.half_v[block], packet.turn_v[block], packet.spread_v[block]);
    }
}

/// Fills the packet with rays of a batch, if they all have one frame and can hit something.
/// @param count     1 to `rays_per_packet`
/// @param places    `places(lane)`: where in the batch the rays of as many lanes stand, from `lane` on;
///                  lanes behind the last ray repeat it
/// @return whether they have
template <class PlacesOf>
[[nodiscard]] HWY_INLINE bool load_loose(const PacketSource& source, const rebuild::Bounds3& grid,
                                         std::size_t first_ray, std::size_t count, const PlacesOf& places,
                                         Packet& packet) {
    assert(count >= 1 && count <= rays_per_packet);
    const LaneTag d;
    const hn::RebindToUnsigned<LaneTag> du;
    const hn::RebindToSigned<LaneTag> di;
    const RayBatch& rays = source.rays;
    const RayFrame frame = ray_frame(rays, first_ray);
    if (frame.hits_nothing()) return false;
    packet.axes = frame.axes;
    packet.ray_count = static_cast<std::uint32_t>(count);
    const std::array<int, 3> axes{frame.axes.k, frame.axes.u(), frame.axes.v()};
    const std::array<float*, 3> origins{packet.origin_k, packet.origin_u, packet.origin_v};
    const Lanes face = hn::Set(d, static_cast<float>(frame.axes.face()));
    const Lanes largest = hn::Set(d, rebuild::largest_coordinate);
    Lanes low[3] = {largest, largest, largest};
    Lanes high[3] = {hn::Neg(largest), hn::Neg(largest), hn::Neg(largest)};
    for (std::size_t lane = 0; lane < packet.block_count() * rays_per_block; lane += hn::Lanes(d)) {
        const auto place = places(lane);
        hn::Store(place, du, packet.ray + lane);
        const auto read = [&](const rebuild::Buffer<float>& values)
                              HWY_ATTR { return hn::GatherIndex(d, values.data(), hn::BitCast(di, place)); };
        const FramedLanes framed = frame_lanes(read(rays.direction[0]), read(rays.direction[1]),
                                               read(rays.direction[2]), read(rays.t_min), read(rays.t_max));
        auto good = hn::Eq(framed.face, face);
        for (std::size_t i = 0; i < 3; ++i) {
            const Lanes start = read(rays.origin[static_cast<std::size_t>(axes[i])]);
            good = hn::And(good, hn::Le(hn::Abs(start), largest));
            low[i] = hn::Min(low[i], start);
            high[i] = hn::Max(high[i], start);
            hn::Store(start, d, origins[i] + lane);
        }
        if (!hn::AllTrue(d, good)) return false;
        hn::Store(framed.slope_u, d, packet.slope_u + lane);
        hn::Store(framed.slope_v, d, packet.slope_v + lane);
        hn::Store(framed.depth_per_t, d, packet.depth_per_t + lane);
        hn::Store(framed.depth_min, d, packet.depth_min + lane);
        hn::Store(framed.depth_max, d, packet.depth_max + lane);
    }
    rebuild::Bounds3 starts;
    for (std::size_t i = 0; i < 3; ++i) {
        starts.min[axes[i]] = hn::GetLane(hn::MinOfLanes(d, low[i]));
        starts.max[axes[i]] = hn::GetLane(hn::MaxOfLanes(d, high[i]));
    }
    packet.origin[axes[0]] = frame.axes.negative ? starts.max[axes[0]] : starts.min[axes[0]];
    packet.origin[axes[1]] = packet.origin_u[0];
    packet.origin[axes[2]] = packet.origin_v[0];
    packet.margin = place_error(packet.origin, grid, starts);
    for (std::size_t lane = 0; lane < packet.block_count() * rays_per_block; lane += hn::Lanes(d)) {
        hn::Store(hn::Mul(hn::Sub(hn::Load(d, packet.origin_k + lane), hn::Set(d, packet.origin[axes[0]])),
                          hn::Set(d, frame.axes.sign())),
                  d, packet.begin + lane);
    }
    finish_loading<Bundle::loose>(source, packet);
    bound_loose(packet, grid);
    return true;
}

/// Rays at `order[0]` to `order[count - 1]` of the batch.
[[nodiscard]] HWY_INLINE bool load_loose_chosen(const PacketSource& source, const rebuild::Bounds3& grid,
                                                const std::uint32_t* order, std::size_t count,
                                                Packet& packet) {
    return load_loose(source, grid, order[0], count, places_in(order, count), packet);
}

/// Rays [begin, begin + count) of the batch.
[[nodiscard]] HWY_INLINE bool load_loose_run(const PacketSource& source, const rebuild::Bounds3& grid,
                                             std::size_t begin, std::size_t count, Packet& packet) {
    return load_loose(source, grid, begin, count, places_from(begin, count), packet);
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
