#pragma once
// Coherent grid traversal: a batch with a common origin or direction, packet by packet.

#include "traversal/grid_scene.h"
#include "traversal/packet.h"
#include "traversal/packet_options.h"
#include "traversal/ray_sort.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

#include <array>
#include <cstddef>

namespace gridreel::traversal {

/// A batch with a common origin or direction, cut into packets.
class PacketSource {
public:
    /// @param begun        with `batch`
    /// @param sorted_rays  of `batch`; nullptr: packets are cut in the batch's own order
    PacketSource(const RayBatch& batch, const ResumedRays& begun, const SortedRays* sorted_rays,
                 const PacketOptions& options = {});

    [[nodiscard]] std::size_t packet_count() const { return packet_begin_.back(); }
    [[nodiscard]] Bundle bundle() const { return rays.common_direction ? Bundle::parallel : Bundle::pencil; }

    const RayBatch& rays;
    const ResumedRays& resumed;
    const SortedRays* sorted;

    /// The rays of one packet: places in the order. Of sorted rays they all have the frame `axes`.
    struct Cut {
        std::size_t begin, end;
        Axes axes;
    };
    [[nodiscard]] Cut cut(std::size_t packet) const;

private:
    std::size_t packet_size_;                                 ///< rays, at most `rays_per_packet`
    std::array<std::size_t, face_count + 2> packet_begin_{};  ///< of each face, and of the dead
};

/// Finds the closest hit of every ray of packets [begin, end) (Wald et al. 2006, section 3): walks the grid
/// slice by slice along K, collects the triangles of the cells that the packet's frustum overlaps, and culls
/// them against the frustum and against each block before any ray is tested.
TraceReport closest_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                               std::size_t end, HitBatch& hits);

/// The same until every ray is blocked by something.
TraceReport any_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                           std::size_t end, OcclusionBatch& occluded);

/// Packets that `any_where_cheap` judges together.
inline constexpr std::size_t packets_per_attempt = 16;

/// The same of packets in a batch's own order, of which nothing is known, as far as that takes less work than
/// sorting them: where few of some neighbours' packets do, or one is too wide, rays are left `undecided`.
/// @param begin  a multiple of `packets_per_attempt`; so is `end`, unless it is the last packet's
TraceReport any_where_cheap(const GridScene& scene, const PacketSource& source, std::size_t begin,
                            std::size_t end, OcclusionBatch& occluded);

}  // namespace gridreel::traversal
