// Depths of parallel rays, each of which starts at its own. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_PARALLEL_DEPTHS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_PARALLEL_DEPTHS_INL_H_
#undef GRIDREEL_TRAVERSAL_PARALLEL_DEPTHS_INL_H_
#else
#define GRIDREEL_TRAVERSAL_PARALLEL_DEPTHS_INL_H_
#endif

#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/rounding.h"

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// The least depth from the packet's origin at which a hit of the block with ray `first` can count.
HWY_INLINE float nearest_parallel_depth(const Packet& packet, std::size_t first) {
    const LaneTag d;
    const auto of_lanes = [&](std::size_t lane) HWY_ATTR {
        // A hit just behind depth_min may be rounded beyond it from a slice before.
        return hn::MulAdd(hn::Load(d, packet.depth_min + lane),
                          hn::Set(d, 1.0f - static_cast<float>(depth_error)),
                          hn::Load(d, packet.begin + lane));
    };
    Lanes nearest = of_lanes(first);
    for (std::size_t lane = first + hn::Lanes(d); lane < first + rays_per_block; lane += hn::Lanes(d)) {
        nearest = hn::Min(nearest, of_lanes(lane));
    }
    return hn::GetLane(hn::MinOfLanes(d, nearest));
}

/// The greatest depth from the packet's origin that a nearer hit of the block with ray `first` can have, or
/// something negative when the block is done.
HWY_INLINE float farthest_parallel_depth(const Packet& packet, std::size_t first) {
    const LaneTag d;
    const auto of_lanes = [&](std::size_t lane) HWY_ATTR {
        const Lanes depth = hn::Load(d, packet.depth + lane);
        // A hit that belongs to a later slice may be rounded nearer than this.
        const Lanes reach = hn::MulAdd(depth, hn::Set(d, 1.0f + static_cast<float>(depth_error)),
                                       hn::Load(d, packet.begin + lane));
        const auto done = hn::Lt(depth, hn::Zero(d));
        return hn::IfThenElse(done, depth, hn::Add(reach, hn::Set(d, packet.margin)));
    };
    Lanes farthest = of_lanes(first);
    for (std::size_t lane = first + hn::Lanes(d); lane < first + rays_per_block; lane += hn::Lanes(d)) {
        farthest = hn::Max(farthest, of_lanes(lane));
    }
    return hn::GetLane(hn::MaxOfLanes(d, farthest));
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
