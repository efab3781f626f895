// From a batch to packets and back. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PACKET_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PACKET_LOAD_INL_H_
#undef GRIDREEL_TRAVERSAL_PACKET_LOAD_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PACKET_LOAD_INL_H_
#endif

#include "traversal/framed_lanes-inl.h"
#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/packet_kernel.h"
#include "traversal/parallel_depths-inl.h"
#include "traversal/rounding.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Least and greatest slope of each block, its depths, and what follows from them.
template <Bundle bundle = Bundle::pencil>
HWY_INLINE void bound_blocks(Packet& packet) {
    const LaneTag d;
    const auto reduced = [&](const float* of_block, const auto& combine, const auto& across) {
        Lanes all = hn::Load(d, of_block);
        for (std::size_t first = hn::Lanes(d); first < rays_per_block; first += hn::Lanes(d)) {
            all = combine(all, hn::Load(d, of_block + first));
        }
        return hn::GetLane(across(all));
    };
    const auto least = [&](const float* of_block) {
        return reduced(
            of_block, [](Lanes a, Lanes b) { return hn::Min(a, b); },
            [&](Lanes a) { return hn::MinOfLanes(d, a); });
    };
    const auto greatest = [&](const float* of_block) {
        return reduced(
            of_block, [](Lanes a, Lanes b) { return hn::Max(a, b); },
            [&](Lanes a) { return hn::MaxOfLanes(d, a); });
    };
    for (std::size_t block = 0; block < blocks_per_packet; ++block) {
        if (block >= packet.block_count()) {
            packet.centre_u[block] = packet.centre_v[block] = packet.half_u[block] = packet.half_v[block] =
                0.0f;
            packet.near_depth[block] = 0.0f;
            packet.far_depth[block] = -1.0f;
            continue;
        }
        const std::size_t first = block * rays_per_block;
        if constexpr (bundle != Bundle::loose) {
            const auto bound = [&](const float* slopes, float& centre, float& half) {
                const float low = least(slopes), high = greatest(slopes);
                centre = 0.5f * (low + high);
                half = std::max(high - centre, centre - low) + packet.margin;
            };
            bound(packet.slope_u + first, packet.centre_u[block], packet.half_u[block]);
            bound(packet.slope_v + first, packet.centre_v[block], packet.half_v[block]);
        }
        // A hit just behind depth_min may be rounded beyond it from a slice before.
        if constexpr (bundle != Bundle::pencil) {
            packet.near_depth[block] = nearest_parallel_depth(packet, first);
            packet.far_depth[block] = farthest_parallel_depth(packet, first);
        } else {
            packet.near_depth[block] =
                least(packet.depth_min + first) * (1.0f - static_cast<float>(depth_error));
            packet.far_depth[block] = greatest(packet.depth + first);
        }
    }
}

/// What all ways to fill a packet end with: nothing is hit yet, resumed rays begin where they go on, blocks
/// have bounds.
template <Bundle bundle = Bundle::pencil>
HWY_INLINE void finish_loading(const PacketSource& source, Packet& packet) {
    const LaneTag d;
    const hn::RebindToUnsigned<LaneTag> du;
    const std::size_t lanes = packet.block_count() * rays_per_block;
    for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(d)) {
        const auto within = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(lane)));
        const auto real = hn::RebindMask(d, hn::Lt(within, hn::Set(du, packet.ray_count)));
        const Lanes depth_max = hn::Load(d, packet.depth_max + lane);
        hn::Store(hn::IfThenElse(real, depth_max, hn::Set(d, -1.0f)), d, packet.depth + lane);
        hn::Store(hn::Set(du, no_hit_yet), du, packet.triangle + lane);
        hn::Store(hn::Set(du, no_triangle), du, packet.after + lane);
    }
    if (!source.rays.after_triangle.empty()) {
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const RayFrame frame = source.resumed.frame(source.rays, packet.ray[lane]);
            packet.depth_min[lane] = frame.depth_min;
            packet.after[lane] = frame.after;
        }
    }
    bound_blocks<bundle>(packet);
}

/// Fills the packet with rays of one face. Only closest hits need `depth_per_t`.
template <Wanted wanted>
HWY_INLINE void load_sorted(const PacketSource& source, const PacketSource::Cut& cut, Packet& packet) {
    const LaneTag d;
    const hn::FixedTag<float, 4> four;
    const auto count = static_cast<std::uint32_t>(cut.end - cut.begin);
    packet.origin = *source.rays.common_origin;
    packet.axes = cut.axes;
    packet.margin = rounding_margin;
    packet.ray_count = count;
    const std::uint32_t* order = source.sorted->order.data() + cut.begin;
    const FramedRay* framed = source.sorted->framed.data();
    const float* along = source.rays.direction[std::size_t(cut.axes.k)].data();

    // While this packet is traced, the rays of the next are on their way.
    const std::size_t next_end = std::min(cut.end + rays_per_packet, source.sorted->order.size());
    for (std::size_t next = cut.end; next < next_end; ++next) {
        hwy::Prefetch(&framed[source.sorted->order[next]]);
    }

    HWY_ALIGN float staged[group][4];
    for (std::size_t block = 0; block < packet.block_count(); ++block) {
        const std::size_t begin = block * rays_per_block;
        for (std::size_t i = 0; i < rays_per_block; ++i) {
            const std::uint32_t ray = order[std::min<std::size_t>(begin + i, count - 1)];
            packet.ray[begin + i] = ray;
            if (wanted == Wanted::closest) packet.depth_per_t[begin + i] = std::fabs(along[ray]);
            hn::Store(hn::Load(four, &framed[ray].slope_u), four, staged[i]);
        }
        for (std::size_t first = 0; first < rays_per_block; first += hn::Lanes(d)) {
            const std::size_t lane = begin + first;
            Lanes slope_u, slope_v, depth_min, depth_max;
            hn::LoadInterleaved4(d, staged[first], slope_u, slope_v, depth_min, depth_max);
            hn::Store(slope_u, d, packet.slope_u + lane);
            hn::Store(slope_v, d, packet.slope_v + lane);
            hn::Store(depth_min, d, packet.depth_min + lane);
            hn::Store(depth_max, d, packet.depth_max + lane);
        }
    }
    finish_loading(source, packet);
}

/// Fills the packet with rays [begin, begin + count) of the batch, if they all have one frame and can hit
/// something. @return whether they have
HWY_INLINE bool load_uniform(const PacketSource& source, std::size_t begin, std::size_t count,
                             Packet& packet) {
    assert(count >= 1 && count <= rays_per_packet);
    const LaneTag d;
    const hn::RebindToUnsigned<LaneTag> du;
    const hn::RebindToSigned<LaneTag> di;
    const RayBatch& rays = source.rays;
    const RayFrame first = ray_frame(rays, begin);
    if (first.hits_nothing()) return false;
    packet.origin = *rays.common_origin;
    packet.axes = first.axes;
    packet.margin = rounding_margin;
    packet.ray_count = static_cast<std::uint32_t>(count);
    const Lanes face = hn::Set(d, static_cast<float>(first.axes.face()));

    for (std::size_t lane = 0; lane < packet.block_count() * rays_per_block; lane += hn::Lanes(d)) {
        // Where these rays stand in the batch; lanes behind the last ray repeat it.
        const auto within = hn::Add(hn::Iota(du, 0), hn::Set(du, static_cast<std::uint32_t>(lane)));
        const auto place = hn::Add(hn::Min(within, hn::Set(du, static_cast<std::uint32_t>(count - 1))),
                                   hn::Set(du, static_cast<std::uint32_t>(begin)));
        const bool side_by_side = lane + hn::Lanes(d) <= count;
        const auto read = [&](const rebuild::Buffer<float>& values) {
            return side_by_side ? hn::LoadU(d, values.data() + begin + lane)
                                : hn::GatherIndex(d, values.data(), hn::BitCast(di, place));
        };

        const FramedLanes ray = frame_lanes(read(rays.direction[0]), read(rays.direction[1]),
                                            read(rays.direction[2]), read(rays.t_min), read(rays.t_max));
        if (!hn::AllTrue(d, hn::Eq(ray.face, face))) return false;

        hn::Store(ray.slope_u, d, packet.slope_u + lane);
        hn::Store(ray.slope_v, d, packet.slope_v + lane);
        hn::Store(ray.depth_per_t, d, packet.depth_per_t + lane);
        hn::Store(ray.depth_min, d, packet.depth_min + lane);
        hn::Store(ray.depth_max, d, packet.depth_max + lane);
        hn::Store(place, du, packet.ray + lane);
    }
    finish_loading(source, packet);
    return true;
}

/// Fills the packet with rays that all have one origin and the frame `axes`, one by one.
/// @param rays  1 to `rays_per_packet` positions in the batch, none of which hits nothing
HWY_INLINE void load_chosen(const PacketSource& source, Axes axes, std::span<const std::uint32_t> rays,
                            Packet& packet) {
    assert(!rays.empty() && rays.size() <= rays_per_packet);
    packet.origin = source.rays.origin_of(rays[0]);
    packet.axes = axes;
    packet.margin = rounding_margin;
    packet.ray_count = static_cast<std::uint32_t>(rays.size());
    for (std::size_t lane = 0; lane < packet.block_count() * rays_per_block; ++lane) {
        const std::uint32_t ray = rays[std::min(lane, rays.size() - 1)];
        const RayFrame frame = ray_frame(source.rays, ray);
        packet.slope_u[lane] = frame.slope_u;
        packet.slope_v[lane] = frame.slope_v;
        packet.depth_per_t[lane] = frame.depth_per_t;
        packet.depth_min[lane] = frame.depth_min;
        packet.depth_max[lane] = frame.depth_max;
        packet.ray[lane] = ray;
    }
    finish_loading(source, packet);
}

/// Writes the packet's hits into the batch.
HWY_INLINE void store_hits(const Packet& packet, HitBatch& hits) {
    const LaneTag d;
    const hn::RebindToUnsigned<LaneTag> du;
    HWY_ALIGN float t[rays_per_block];
    HWY_ALIGN std::uint32_t triangle[rays_per_block];
    for (std::size_t block = 0; block < packet.ray_count; block += rays_per_block) {
        for (std::size_t first = 0; first < rays_per_block; first += hn::Lanes(d)) {
            const std::size_t lane = block + first;
            const Lanes depth = hn::Load(d, packet.depth + lane);
            const auto hit = hn::Lt(depth, hn::Load(d, packet.depth_max + lane));
            hn::Store(hn::IfThenElse(hit, hn::Div(depth, hn::Load(d, packet.depth_per_t + lane)), hn::Inf(d)),
                      d, t + first);
            hn::Store(hn::IfThenElse(hn::RebindMask(du, hit), hn::Load(du, packet.triangle + lane),
                                     hn::Set(du, no_triangle)),
                      du, triangle + first);
        }
        const std::size_t count = std::min(rays_per_block, packet.ray_count - block);
        for (std::size_t i = 0; i < count; ++i) {
            hits.t[packet.ray[block + i]] = t[i];
            hits.triangle[packet.ray[block + i]] = triangle[i];
        }
    }
}

/// Writes which of the packet's rays are blocked, one after the other.
/// @param open  a bit for each block whose other rays are `undecided`
HWY_INLINE void store_run(const Packet& packet, BlockMask open, std::uint8_t* occluded) {
    const LaneTag d;
    const hn::RebindToSigned<LaneTag> di;
    const hn::Rebind<std::uint8_t, LaneTag> du8;
    HWY_ALIGN std::uint8_t answers[rays_per_block];
    for (std::size_t begin = 0; begin < packet.ray_count; begin += rays_per_block) {
        const bool is_open = (open >> begin / rays_per_block & 1) != 0;
        const auto unblocked = hn::Set(di, is_open ? std::int32_t{undecided} : 0);
        for (std::size_t first = 0; first < rays_per_block; first += hn::Lanes(d)) {
            const auto blocked =
                hn::RebindMask(di, hn::Lt(hn::Load(d, packet.depth + begin + first), hn::Zero(d)));
            const auto answer = hn::IfThenElse(blocked, hn::Set(di, 1), unblocked);
            hn::StoreU(hn::DemoteTo(du8, answer), du8, answers + first);
        }
        const std::size_t count = std::min(rays_per_block, packet.ray_count - begin);
        if (HWY_LIKELY(count == rays_per_block)) {
            std::memcpy(occluded + begin, answers, rays_per_block);
        } else {
            std::copy_n(answers, count, occluded + begin);
        }
    }
}

/// Writes which of the packet's rays are blocked into the batch.
HWY_INLINE void store_occlusion(const Packet& packet, OcclusionBatch& occluded) {
    for (std::size_t lane = 0; lane < packet.ray_count; ++lane) {
        occluded[packet.ray[lane]] = packet.depth[lane] < 0.0f;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
