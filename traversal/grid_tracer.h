#pragma once
// The grid behind the tracer interface.

#include "rebuild/grid_builder.h"
#include "rebuild/macrocells.h"
#include "traversal/cell_digest.h"
#include "traversal/grid_scene.h"
#include "traversal/ray_sort.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

namespace gridreel::traversal {

/// Rebuilds a uniform grid and traces rays through it: batches with a common origin or direction as coherent
/// packets, and those of others whose neighbours run nearly the same way; the rest a few at a time, each on
/// its own way; or, if told so, all of them ray by ray.
class GridTracer final : public Tracer {
public:
    enum class Traversal { coherent, one_by_one };

    /// @throws std::invalid_argument for a packet side beyond 1 to `widest_packet_side`
    GridTracer(const rebuild::ResolutionPolicy& resolution, Traversal traversal,
               const PacketOptions& packets = {});

    rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) override;
    void set_lambda(float lambda) override { builder_.set_lambda(lambda); }
    TraceReport closest_hits(const RayBatch& rays, HitBatch& hits) override;
    TraceReport any_hits(const RayBatch& rays, OcclusionBatch& occluded) override;

private:
    [[nodiscard]] GridScene begin(const RayBatch& rays);
    [[nodiscard]] CellDigest digest(std::size_t rays);
    [[nodiscard]] std::size_t digest_bytes() const;
    [[nodiscard]] bool in_packets(const RayBatch& rays) const;
    /// Each ray on its own way.
    template <class Kernel, class Answers>
    TraceReport trace_each(const GridScene& scene, const RayBatch& rays, Kernel kernel, Answers& answers);
    /// Those in packets that run nearly the same way, the others in streams.
    /// @param packets  answers some packets, and says which rays are `left`
    template <class Packets, class Kernel, class Answers>
    TraceReport trace_loose(const GridScene& scene, const RayBatch& rays, const Packets& packets,
                            Kernel streams, OcclusionBatch& left, Answers& answers);
    /// Leaves rays `undecided` that are better sorted.
    TraceReport any_as_they_come(const GridScene& scene, const RayBatch& rays, OcclusionBatch& occluded);

    Traversal traversal_;
    PacketOptions packets_;
    rebuild::GridBuilder builder_;
    rebuild::Macrocells macrocells_;
    CellDistances distances_;
    ReferenceBoxes boxes_;
    int distances_most_ = 0;    ///< of the grid as it is
    bool boxes_known_ = false;  ///< too
    rebuild::TriangleView triangles_;
    ResumedRays resumed_;
    RaySort ray_sort_;
    OcclusionBatch left_;  ///< `undecided` rays of a batch without common origin or direction
};

}  // namespace gridreel::traversal
