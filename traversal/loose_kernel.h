#pragma once
// Packets of rays that have neither origin nor direction in common, but run nearly the same way.

#include "traversal/grid_scene.h"
#include "traversal/packet_kernel.h"
#include "traversal/tracer.h"

#include <cstddef>

namespace gridreel::traversal {

/// Finds the closest hit of every ray of packets [begin, end) that walking as a packet is worth it for
/// (Boulos et al., "Packet-based Whitted and Distribution Ray Tracing", 2007); the others are left
/// `undecided`.
/// @param source  rays without a common origin or direction, in their own order
/// @param left    for every ray whether it is `undecided`, else 0
TraceReport closest_in_loose_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                                     std::size_t end, HitBatch& hits, OcclusionBatch& left);

/// The same until every such ray is blocked by something.
TraceReport any_in_loose_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                                 std::size_t end, OcclusionBatch& occluded);

}  // namespace gridreel::traversal
