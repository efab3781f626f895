#pragma once
// Coherent grid traversal: a batch with a common origin, packet by packet.

#include "traversal/grid_scene.h"
#include "traversal/packet.h"
#include "traversal/ray_sort.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

#include <cstddef>

namespace gridreel::traversal {

/// A batch with a common origin, and the order to cut packets from.
struct PacketSource {
    const RayBatch& rays;
    const ResumedRays& resumed;          ///< begun with `rays`
    const SortedRays* sorted = nullptr;  ///< of `rays`; nullptr: the batch's own order

    /// Rays, or runs of sorted rays: what pieces of work are counted in.
    [[nodiscard]] std::size_t size() const { return sorted ? sorted->order.size() : rays.size(); }
};

/// Finds the closest hits of [begin, end) of the source, in packets of up to `rays_per_packet` (Wald et al.
/// 2006, section 3): walks the grid slice by slice along K, collects the triangles of the cells that the
/// packet's frustum overlaps, and culls them against the frustum and against each block before any ray is
/// tested.
TraceReport closest_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                               std::size_t end, HitBatch& hits);

/// The same until every ray is blocked by something.
TraceReport any_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                           std::size_t end, OcclusionBatch& occluded);

}  // namespace gridreel::traversal
