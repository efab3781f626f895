#pragma once
// Coherent grid traversal: a batch with a common origin, packet by packet.

#include "traversal/grid_scene.h"
#include "traversal/packet.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace gridreel::traversal {

/// A batch with a common origin, cut into packets of `rays_per_packet` in some order.
struct PacketSource {
    const RayBatch& rays;
    const ResumedRays& resumed;            ///< begun with `rays`
    std::span<const std::uint32_t> order;  ///< positions in the batch; empty: the batch's own order

    [[nodiscard]] std::uint32_t ray_at(std::size_t i) const {
        return order.empty() ? static_cast<std::uint32_t>(i) : order[i];
    }
    [[nodiscard]] std::size_t packet_count() const {
        return (rays.size() + rays_per_packet - 1) / rays_per_packet;
    }
};

/// Finds the closest hit of every ray of packets [begin, end) (Wald et al. 2006, section 3): walks the grid
/// slice by slice along K, collects the triangles of the cells that the packet's frustum overlaps, and culls
/// them against the frustum and against each block before any ray is tested.
TraceReport closest_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                               std::size_t end, HitBatch& hits);

/// The same until every ray is blocked by something.
TraceReport any_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                           std::size_t end, OcclusionBatch& occluded);

}  // namespace gridreel::traversal
