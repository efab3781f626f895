// A packet of rays against waiting triangles: 16 triangles against the frustum, each survivor against the
// blocks, each block left ray by ray. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PACKET_INTERSECT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PACKET_INTERSECT_INL_H_
#undef GRIDREEL_TRAVERSAL_PACKET_INTERSECT_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PACKET_INTERSECT_INL_H_
#endif

#include "traversal/block_boxes-inl.h"
#include "traversal/candidates.h"
#include "traversal/corner_table-inl.h"
#include "traversal/grid_scene.h"
#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/packet_frustum-inl.h"
#include "traversal/parallel_depths-inl.h"
#include "traversal/parallel_meeting-inl.h"
#include "traversal/parallel_triangle-inl.h"
#include "traversal/tracer.h"
#include "traversal/triangle-inl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

inline constexpr int plane_row = 3;

/// The edge functions of 16 triangles, triangle by triangle.
struct alignas(64) EdgeTable {
    float k[4][group], u[4][group], v[4][group];  // three edges, then the plane
    float volume[group], error[group], sure[group], depth_min[group], depth_max[group];
    StepTable steps;
};

/// Whether any direction within the bounds can be inside all three edges, lane by lane: the edge function's
/// greatest value is at a corner of the bounds. No division, so nothing behind the origin confuses it.
/// @param centre  less the aim's slopes
HWY_INLINE hn::Mask<LaneTag> may_be_inside(LaneTag d, const EdgeFunctions<Lanes>& edges,
                                           const Slopes<Lanes>& centre, const Slopes<Lanes>& half) {
    // Once for the ray's doubt, once for the roundings here.
    const Lanes least = hn::Neg(hn::Add(edges.error, edges.error));
    auto inside = hn::Ge(edges.depth_max, hn::Zero(d));
    for (const Vec3<Lanes>& n : edges.normal) {
        Lanes greatest = along(n, centre);
        greatest = hn::MulAdd(half.u, hn::Abs(n.u), greatest);
        greatest = hn::MulAdd(half.v, hn::Abs(n.v), greatest);
        inside = hn::And(inside, hn::Ge(greatest, least));
    }
    return inside;
}

/// A triangle whose box meets more blocks than this is held against each block's edge functions first.
constexpr int few_blocks = 4;

HWY_INLINE SlopeBox<Lanes> slope_box(LaneTag d, const Vec3<Lanes>& a, const Vec3<Lanes>& b,
                                     const Vec3<Lanes>& c, Lanes sign, const Slopes<Lanes>& aim) {
    const auto slopes = [&](const Vec3<Lanes>& p) {
        const Lanes depth = hn::Mul(p.k, sign);
        const Lanes per_depth = hn::Div(hn::Set(d, 1.0f), depth);
        return Slopes<Lanes>{hn::Mul(hn::NegMulAdd(aim.u, depth, p.u), per_depth),
                             hn::Mul(hn::NegMulAdd(aim.v, depth, p.v), per_depth)};
    };
    const Slopes<Lanes> at_a = slopes(a), at_b = slopes(b), at_c = slopes(c);
    // Far enough in front for the division, too.
    const Lanes nearest = hn::Min(hn::Mul(a.k, sign), hn::Min(hn::Mul(b.k, sign), hn::Mul(c.k, sign)));
    const auto in_front = hn::Gt(nearest, hn::Set(d, 0x1p-100f));
    const auto low = [&](Lanes x, Lanes y, Lanes z) {
        const Lanes least = hn::Min(x, hn::Min(y, z));
        const Lanes margin =
            hn::MulAdd(hn::Abs(least), hn::Set(d, rounding_margin), hn::Set(d, rounding_margin));
        return hn::IfThenElse(in_front, hn::Sub(least, margin), hn::Neg(hn::Inf(d)));
    };
    const auto high = [&](Lanes x, Lanes y, Lanes z) {
        const Lanes greatest = hn::Max(x, hn::Max(y, z));
        const Lanes margin =
            hn::MulAdd(hn::Abs(greatest), hn::Set(d, rounding_margin), hn::Set(d, rounding_margin));
        return hn::IfThenElse(in_front, hn::Add(greatest, margin), hn::Inf(d));
    };
    return {.low_u = low(at_a.u, at_b.u, at_c.u),
            .high_u = high(at_a.u, at_b.u, at_c.u),
            .low_v = low(at_a.v, at_b.v, at_c.v),
            .high_v = high(at_a.v, at_b.v, at_c.v)};
}

/// Edge functions of 16 triangles into `table`. @return a bit for each that the frustum does not cull
template <Bundle bundle>
HWY_INLINE unsigned cull_by_frustum(const CornerTable<group>& corners, const Packet& packet,
                                    const Frustum& frustum, const BlockBoxes& boxes, EdgeTable& table) {
    const LaneTag d;
    const Viewpoint seen(packet.origin, packet.axes);
    const Slopes<Lanes> half{hn::Set(d, frustum.half_u), hn::Set(d, frustum.half_v)};
    const Aim<Lanes> aim{.slopes = frustum.centre(d), .half = hn::Max(half.u, half.v)};
    unsigned survivors = 0;
    for (std::size_t first = 0; first < group; first += hn::Lanes(d)) {
        const Vec3<Lanes> a = corners.lanes(d, 0, first, seen), b = corners.lanes(d, 1, first, seen),
                          c = corners.lanes(d, 2, first, seen);
        const Lanes sign = hn::Set(d, packet.axes.sign());
        EdgeFunctions<Lanes> edges;
        SlopeBox<Lanes> box;
        if constexpr (bundle == Bundle::parallel) {
            const Slopes<Lanes> slopes{hn::Set(d, packet.common_slope_u), hn::Set(d, packet.common_slope_v)};
            const auto places = places_along(d, a, b, c, sign, slopes, aim.slopes);
            edges = edge_functions(d, places, aim.half, hn::Set(d, packet.margin));
            box = place_box(places, hn::Set(d, packet.margin));
        } else {
            edges = edge_functions(d, a, b, c, sign, aim);
            box = slope_box(d, a, b, c, sign, aim.slopes);
        }
        boxes.store_steps(box, first, table.steps);
        const auto in_box = hn::And(hn::And(hn::Le(box.low_u, half.u), hn::Ge(box.high_u, hn::Neg(half.u))),
                                    hn::And(hn::Le(box.low_v, half.v), hn::Ge(box.high_v, hn::Neg(half.v))));
        const auto inside = hn::And(in_box, may_be_inside(d, edges, {hn::Zero(d), hn::Zero(d)}, half));
        const auto in_reach = hn::And(hn::Le(edges.depth_min, hn::Set(d, frustum.far_depth)),
                                      hn::Ge(edges.depth_max, hn::Set(d, frustum.near_depth)));
        survivors |= bits_of(d, hn::And(inside, in_reach)) << first;
        const auto store = [&](const Vec3<Lanes>& normal, int row) {
            hn::Store(normal.k, d, table.k[row] + first);
            hn::Store(normal.u, d, table.u[row] + first);
            hn::Store(normal.v, d, table.v[row] + first);
        };
        for (int edge = 0; edge < 3; ++edge) store(edges.normal[edge], edge);
        store(edges.plane, plane_row);
        hn::Store(edges.volume, d, table.volume + first);
        hn::Store(edges.error, d, table.error + first);
        hn::Store(edges.sure, d, table.sure + first);
        hn::Store(edges.depth_min, d, table.depth_min + first);
        hn::Store(edges.depth_max, d, table.depth_max + first);
    }
    return survivors;
}

HWY_INLINE EdgeFunctions<Lanes> broadcast(const EdgeTable& table, int triangle) {
    const LaneTag d;
    EdgeFunctions<Lanes> edges;
    const auto row_of = [&](int row) {
        return Vec3<Lanes>{hn::Set(d, table.k[row][triangle]), hn::Set(d, table.u[row][triangle]),
                           hn::Set(d, table.v[row][triangle])};
    };
    for (int edge = 0; edge < 3; ++edge) edges.normal[edge] = row_of(edge);
    edges.plane = row_of(plane_row);
    edges.volume = hn::Set(d, table.volume[triangle]);
    edges.error = hn::Set(d, table.error[triangle]);
    edges.sure = hn::Set(d, table.sure[triangle]);
    edges.depth_min = hn::Set(d, table.depth_min[triangle]);
    edges.depth_max = hn::Set(d, table.depth_max[triangle]);
    return edges;
}

/// One triangle against all blocks, a lane a block. @return a bit for each block that must look closer
HWY_INLINE BlockMask blocks_that_may_hit(const Packet& packet, const Slopes<Lanes>& aim,
                                         const EdgeFunctions<Lanes>& edges) {
    const LaneTag d;
    BlockMask blocks = 0;
    for (std::size_t first = 0; first < blocks_per_packet; first += hn::Lanes(d)) {
        const Slopes<Lanes> centre{hn::Load(d, packet.centre_u + first),
                                   hn::Load(d, packet.centre_v + first)};
        const Slopes<Lanes> half{hn::Load(d, packet.half_u + first), hn::Load(d, packet.half_v + first)};
        const auto inside = may_be_inside(d, edges, difference(centre, aim), half);
        const auto in_reach = hn::And(hn::Le(edges.depth_min, hn::Load(d, packet.far_depth + first)),
                                      hn::Ge(edges.depth_max, hn::Load(d, packet.near_depth + first)));
        blocks |= BlockMask{bits_of(d, hn::And(inside, in_reach))} << first;
    }
    return blocks;
}

/// Where rays of a pencil meet a triangle: those in the lanes from `first` on.
/// @param corners  for what the edge functions leave in doubt: the triangle's are at `place`
HWY_INLINE Meeting<LaneTag> meet_pencil(const Packet& packet, const Slopes<Lanes>& aim,
                                        const EdgeFunctions<Lanes>& edges, const CornerTable<group>& corners,
                                        std::size_t place, std::size_t first) {
    const LaneTag d;
    const float* slope_u = packet.slope_u + first;
    const float* slope_v = packet.slope_v + first;
    const auto decide = [&](std::size_t lane) {
        const Viewpoint seen(packet.origin, packet.axes);
        return meet_in_double(corners.point(0, place, seen), corners.point(1, place, seen),
                              corners.point(2, place, seen), packet.axes.sign(), slope_u[lane],
                              slope_v[lane]);
    };
    const Slopes<Lanes> slopes{hn::Load(d, slope_u), hn::Load(d, slope_v)};
    const Lanes least = least_edge(edges, difference(slopes, aim));
    return meet(d, edges, least, slopes, hn::Load(d, packet.depth + first), decide);
}

/// Keeps what comes sooner than the hits so far, of rays from `first` on. Equal depths go to the lower index,
/// whatever the order of tests.
/// @return whether anything does
template <Wanted wanted>
HWY_INLINE bool keep_sooner(Packet& packet, const Meeting<LaneTag>& met, std::uint32_t triangle,
                            std::size_t first) {
    const LaneTag d;
    const hn::RebindToUnsigned<LaneTag> du;
    const auto index = hn::Set(du, triangle);
    const Lanes best = hn::Load(d, packet.depth + first);
    const auto held = hn::Load(du, packet.triangle + first);
    const auto wins_tie = hn::And(hn::Eq(met.depth, best), hn::RebindMask(d, hn::Lt(index, held)));
    const Lanes depth_min = hn::Load(d, packet.depth_min + first);
    const auto is_after = hn::RebindMask(d, hn::Gt(index, hn::Load(du, packet.after + first)));
    const auto begun = hn::Or(hn::Gt(met.depth, depth_min), hn::And(hn::Eq(met.depth, depth_min), is_after));
    const auto closer = hn::And(hn::And(met.inside, begun), hn::Or(hn::Lt(met.depth, best), wins_tie));
    if (hn::AllFalse(d, closer)) return false;
    const Lanes depth = wanted == Wanted::any ? hn::Set(d, -1.0f) : met.depth;
    hn::Store(hn::IfThenElse(closer, depth, best), d, packet.depth + first);
    hn::Store(hn::IfThenElse(hn::RebindMask(du, closer), index, held), du, packet.triangle + first);
    return true;
}

/// One triangle against the rays of one block.
/// @param corners  for what the edge functions leave in doubt: the triangle's are at `place`
template <Wanted wanted, Bundle bundle>
HWY_INLINE void intersect_block(Packet& packet, const Slopes<Lanes>& aim, const EdgeFunctions<Lanes>& edges,
                                const CornerTable<group>& corners, std::size_t place, std::uint32_t triangle,
                                int block) {
    const LaneTag d;
    bool changed = false;
    const std::size_t begin = static_cast<std::size_t>(block) * rays_per_block;
    for (std::size_t first = begin; first < begin + rays_per_block; first += hn::Lanes(d)) {
        const auto met = bundle == Bundle::parallel
                             ? meet_parallel<wanted>(packet, aim, edges, corners, place, first)
                             : meet_pencil(packet, aim, edges, corners, place, first);
        if (keep_sooner<wanted>(packet, met, triangle, first)) changed = true;
    }
    if (!changed) return;
    if constexpr (bundle == Bundle::parallel) {
        packet.far_depth[block] = farthest_parallel_depth(packet, begin);
    } else {
        Lanes farthest = hn::Load(d, packet.depth + begin);
        for (std::size_t i = begin + hn::Lanes(d); i < begin + rays_per_block; i += hn::Lanes(d)) {
            farthest = hn::Max(farthest, hn::Load(d, packet.depth + i));
        }
        packet.far_depth[block] = hn::GetLane(hn::MaxOfLanes(d, farthest));
    }
}

/// Intersects the waiting triangles with the active blocks and lets them go.
/// Blocks whose rays need nothing more leave `active`.
template <Wanted wanted, Bundle bundle>
void intersect(const GridScene& scene, Packet& packet, BlockMask& active, Frustum& frustum,
               Candidates& candidates, TraceReport& report) {
    const Slopes<Lanes> aim = frustum.centre(LaneTag());
    if (!frustum.boxes) frustum.boxes.emplace(packet, frustum);
    const BlockBoxes& boxes = *frustum.boxes;
    // While one group is worked on, the corners of the next are on their way.
    CornerTable<group> tables[2];
    EdgeTable edge_table;
    const auto triangles_of = [&](std::size_t begin) { return candidates.data() + begin; };
    const auto gather_at = [&](std::size_t begin) {
        tables[begin / group % 2].gather(scene.triangles, triangles_of(begin),
                                         std::min(group, candidates.size() - begin));
    };
    if (candidates.size() > 0) gather_at(0);
    for (std::size_t begin = 0; begin < candidates.size() && active != 0; begin += group) {
        if (begin + group < candidates.size()) gather_at(begin + group);
        const CornerTable<group>& corners = tables[begin / group % 2];
        unsigned survivors = cull_by_frustum<bundle>(corners, packet, frustum, boxes, edge_table);
        const std::size_t count = std::min(group, candidates.size() - begin);
        if (HWY_UNLIKELY(!scene.packets.culling)) survivors = ~0u;
        survivors &= (1u << count) - 1u;
        for (; survivors != 0; survivors &= survivors - 1) {
            const int i = std::countr_zero(survivors);
            BlockMask blocks = active;
            if (HWY_LIKELY(scene.packets.culling)) {
                blocks &= boxes.touched_by(edge_table.steps, i, edge_table.depth_min[i], packet);
            }
            if (blocks == 0) continue;
            const auto edges = broadcast(edge_table, i);
            // What lies across many blocks is long and thin: few of them are near it.
            if (std::popcount(blocks) > few_blocks && scene.packets.culling) {
                blocks &= blocks_that_may_hit(packet, aim, edges);
            }
            report.triangle_tests += static_cast<std::uint64_t>(std::popcount(blocks)) * rays_per_block;
            for (; blocks != 0; blocks &= blocks - 1) {
                const int block = std::countr_zero(blocks);
                intersect_block<wanted, bundle>(packet, aim, edges, corners, std::size_t(i),
                                                triangles_of(begin)[i], block);
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
