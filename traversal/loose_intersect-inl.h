// A packet of loose rays against waiting triangles: 16 triangles against the frustum, each survivor against
// the blocks, each ray of the blocks left as if alone. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_LOOSE_INTERSECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_LOOSE_INTERSECT_INL_H_
#undef GRIDREEL_TRAVERSAL_LOOSE_INTERSECT_INL_H_
#else
#define GRIDREEL_TRAVERSAL_LOOSE_INTERSECT_INL_H_
#endif

#include "traversal/candidates.h"
#include "traversal/corner_table-inl.h"
#include "traversal/grid_scene.h"
#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/packet_frustum-inl.h"
#include "traversal/packet_intersect-inl.h"
#include "traversal/parallel_depths-inl.h"
#include "traversal/tracer.h"
#include "traversal/triangle-inl.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Bounds of rays across as the depth behind the near plane grows: a frustum's, or a block's a lane.
struct LooseBounds {
    Lanes centre_u, half_u, turn_u, spread_u, centre_v, half_v, turn_v, spread_v;
};

/// Whether boxes around the triangle and the rays overlap, once sheared so that the rays' middle is the axis.
/// @param k         of the corners: depths behind the near plane
/// @param from, to  the triangle's depths between the planes
HWY_INLINE hn::Mask<LaneTag> overlap(const Lanes* k, const Lanes* u, const Lanes* v, Lanes from, Lanes to,
                                     const LooseBounds& rays) {
    const auto along = [&](const Lanes* across, Lanes centre, Lanes half, Lanes turn, Lanes spread) HWY_ATTR {
        const auto place = [&](int i)
                               HWY_ATTR { return hn::NegMulAdd(turn, k[i], hn::Sub(across[i], centre)); };
        const Lanes a = place(0), b = place(1), c = place(2);
        const Lanes widest = hn::Max(hn::MulAdd(from, spread, half), hn::MulAdd(to, spread, half));
        const Lanes low = hn::Min(a, hn::Min(b, c)), high = hn::Max(a, hn::Max(b, c));
        return hn::And(hn::Le(low, widest), hn::Ge(high, hn::Neg(widest)));
    };
    return hn::And(along(u, rays.centre_u, rays.half_u, rays.turn_u, rays.spread_u),
                   along(v, rays.centre_v, rays.half_v, rays.turn_v, rays.spread_v));
}

/// 16 triangles, relative to the packet's origin, depths from the near plane.
struct alignas(64) LooseTriangles {
    float k[3][group], u[3][group], v[3][group];
    float from[group], to[group];
    float nearest[group], farthest[group];  // from the packet's origin
};

/// @return a bit for each triangle that comes near the frustum
HWY_INLINE unsigned cull_loose(const CornerTable<group>& corners, const Packet& packet,
                               const LooseFrustum& frustum, LooseTriangles& table) {
    const LaneTag d;
    const Viewpoint seen(packet.origin, packet.axes);
    const Lanes sign = hn::Set(d, packet.axes.sign());
    const Lanes near_plane = hn::Set(d, packet.near_plane);
    const Lanes way = hn::Set(d, packet.far_plane - packet.near_plane);
    const auto set = [&](const Sweep& sweep, Lanes& centre, Lanes& half, Lanes& turn,
                         Lanes& spread) HWY_ATTR {
        const double low = sweep.low + double(packet.near_plane) * sweep.low_slope;
        const double high = sweep.high + double(packet.near_plane) * sweep.high_slope;
        centre = hn::Set(d, static_cast<float>(0.5 * (low + high)));
        half = hn::Set(d, static_cast<float>(0.5 * (high - low)));
        turn = hn::Set(d, static_cast<float>(0.5 * (sweep.low_slope + sweep.high_slope)));
        spread = hn::Set(d, static_cast<float>(0.5 * (sweep.high_slope - sweep.low_slope)));
    };
    LooseBounds rays;
    set(frustum.u, rays.centre_u, rays.half_u, rays.turn_u, rays.spread_u);
    set(frustum.v, rays.centre_v, rays.half_v, rays.turn_v, rays.spread_v);
    unsigned survivors = 0;
    for (std::size_t first = 0; first < group; first += hn::Lanes(d)) {
        Lanes k[3], u[3], v[3];
        for (int which = 0; which < 3; ++which) {
            const Vec3<Lanes> p = corners.lanes(d, which, first, seen);
            k[which] = hn::MulSub(p.k, sign, near_plane);
            u[which] = p.u;
            v[which] = p.v;
            hn::Store(k[which], d, table.k[which] + first);
            hn::Store(u[which], d, table.u[which] + first);
            hn::Store(v[which], d, table.v[which] + first);
        }
        const Lanes least = hn::Min(k[0], hn::Min(k[1], k[2])), most = hn::Max(k[0], hn::Max(k[1], k[2]));
        const Lanes from = hn::Min(hn::Max(least, hn::Zero(d)), way);
        const Lanes to = hn::Min(hn::Max(most, hn::Zero(d)), way);
        const Lanes margin = hn::Set(d, packet.margin);
        const Lanes nearest = hn::Sub(hn::Add(least, near_plane), margin);
        const Lanes farthest = hn::Add(hn::Add(most, near_plane), margin);
        hn::Store(from, d, table.from + first);
        hn::Store(to, d, table.to + first);
        hn::Store(nearest, d, table.nearest + first);
        hn::Store(farthest, d, table.farthest + first);
        const auto in_reach = hn::And(hn::Le(nearest, hn::Set(d, frustum.far_depth)),
                                      hn::Ge(farthest, hn::Set(d, frustum.near_depth)));
        survivors |= bits_of(d, hn::And(in_reach, overlap(k, u, v, from, to, rays))) << first;
    }
    return survivors;
}

/// @return a bit for each block that comes near the triangle
HWY_INLINE BlockMask blocks_near(const Packet& packet, const LooseTriangles& table, int triangle) {
    const LaneTag d;
    Lanes k[3], u[3], v[3];
    for (int which = 0; which < 3; ++which) {
        k[which] = hn::Set(d, table.k[which][triangle]);
        u[which] = hn::Set(d, table.u[which][triangle]);
        v[which] = hn::Set(d, table.v[which][triangle]);
    }
    const Lanes from = hn::Set(d, table.from[triangle]), to = hn::Set(d, table.to[triangle]);
    const Lanes nearest = hn::Set(d, table.nearest[triangle]),
                farthest = hn::Set(d, table.farthest[triangle]);
    BlockMask blocks = 0;
    for (std::size_t first = 0; first < blocks_per_packet; first += hn::Lanes(d)) {
        const LooseBounds rays{hn::Load(d, packet.centre_u + first), hn::Load(d, packet.half_u + first),
                               hn::Load(d, packet.turn_u + first),   hn::Load(d, packet.spread_u + first),
                               hn::Load(d, packet.centre_v + first), hn::Load(d, packet.half_v + first),
                               hn::Load(d, packet.turn_v + first),   hn::Load(d, packet.spread_v + first)};
        const auto in_reach = hn::And(hn::Le(nearest, hn::Load(d, packet.far_depth + first)),
                                      hn::Ge(farthest, hn::Load(d, packet.near_depth + first)));
        blocks |= BlockMask{bits_of(d, hn::And(in_reach, overlap(k, u, v, from, to, rays)))} << first;
    }
    return blocks;
}

/// Where loose rays meet a triangle: those in the lanes from `first` on, each as if alone.
HWY_INLINE Meeting<LaneTag> meet_loose(const Packet& packet, const CornerTable<group>& corners,
                                       std::size_t place, std::size_t first) {
    const LaneTag d;
    const Axes axes = packet.axes;
    const float* slope_u = packet.slope_u + first;
    const float* slope_v = packet.slope_v + first;
    const auto corner = [&](int which) HWY_ATTR {
        const float* p = corners.corner[which][place];
        return Vec3<Lanes>{hn::Sub(hn::Set(d, p[axes.k]), hn::Load(d, packet.origin_k + first)),
                           hn::Sub(hn::Set(d, p[axes.u()]), hn::Load(d, packet.origin_u + first)),
                           hn::Sub(hn::Set(d, p[axes.v()]), hn::Load(d, packet.origin_v + first))};
    };
    const auto decide = [&](std::size_t lane) {
        const auto point = [&](int which) {
            const float* p = corners.corner[which][place];
            return FramedPoint{.k = p[axes.k] - packet.origin_k[first + lane],
                               .u = p[axes.u()] - packet.origin_u[first + lane],
                               .v = p[axes.v()] - packet.origin_v[first + lane]};
        };
        return meet_in_double(point(0), point(1), point(2), axes.sign(), slope_u[lane], slope_v[lane]);
    };
    return meet_one_ray(d, corner(0), corner(1), corner(2), hn::Set(d, axes.sign()),
                        Slopes<Lanes>{hn::Load(d, slope_u), hn::Load(d, slope_v)},
                        hn::Load(d, packet.depth + first), decide);
}

/// One triangle against the rays of one block.
template <Wanted wanted>
HWY_INLINE void intersect_loose_block(Packet& packet, const CornerTable<group>& corners, std::size_t place,
                                      std::uint32_t triangle, int block) {
    bool changed = false;
    const std::size_t begin = static_cast<std::size_t>(block) * rays_per_block;
    for (std::size_t first = begin; first < begin + rays_per_block; first += hn::Lanes(LaneTag())) {
        const auto met = meet_loose(packet, corners, place, first);
        if (keep_sooner<wanted>(packet, met, triangle, first)) changed = true;
    }
    if (changed) packet.far_depth[block] = farthest_parallel_depth(packet, begin);
}

/// As `intersect`, for loose rays.
template <Wanted wanted>
void intersect_loose(const GridScene& scene, Packet& packet, BlockMask& active, const LooseFrustum& frustum,
                     Candidates& candidates, TraceReport& report) {
    // While one group is worked on, the corners of the next are on their way.
    CornerTable<group> tables[2];
    LooseTriangles triangles;
    const auto gather_at = [&](std::size_t begin) {
        tables[begin / group % 2].gather(scene.triangles, candidates.data() + begin,
                                         std::min(group, candidates.size() - begin));
    };
    gather_at(0);
    for (std::size_t begin = 0; begin < candidates.size() && active != 0; begin += group) {
        if (begin + group < candidates.size()) gather_at(begin + group);
        const CornerTable<group>& corners = tables[begin / group % 2];
        unsigned survivors = cull_loose(corners, packet, frustum, triangles);
        if (HWY_UNLIKELY(!scene.packets.culling)) survivors = ~0u;
        survivors &= (1u << std::min(group, candidates.size() - begin)) - 1u;
        for (; survivors != 0; survivors &= survivors - 1) {
            const int i = std::countr_zero(survivors);
            BlockMask blocks = active;
            if (HWY_LIKELY(scene.packets.culling)) blocks &= blocks_near(packet, triangles, i);
            report.triangle_tests += static_cast<std::uint64_t>(std::popcount(blocks)) * rays_per_block;
            for (; blocks != 0; blocks &= blocks - 1) {
                const int block = std::countr_zero(blocks);
                intersect_loose_block<wanted>(packet, corners, static_cast<std::size_t>(i),
                                              candidates.data()[begin + static_cast<std::size_t>(i)], block);
                if (packet.far_depth[block] < 0.0f) active &= ~(BlockMask{1} << block);
            }
        }
    }
    candidates.drop_all();
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
