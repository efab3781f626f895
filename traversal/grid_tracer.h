#pragma once
// The grid behind the tracer interface.

#include "rebuild/grid_builder.h"
#include "traversal/ray_sort.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

namespace gridreel::traversal {

/// Rebuilds a uniform grid and traces rays through it: batches with a common origin as coherent packets,
/// unless told otherwise, all others ray by ray.
class GridTracer final : public Tracer {
public:
    enum class Traversal { coherent, one_by_one };

    GridTracer(const rebuild::ResolutionPolicy& resolution, Traversal traversal);

    rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) override;
    void set_lambda(float lambda) override { builder_.set_lambda(lambda); }
    TraceReport closest_hits(const RayBatch& rays, HitBatch& hits) override;
    TraceReport any_hits(const RayBatch& rays, OcclusionBatch& occluded) override;

private:
    template <class Packets, class OneByOne>
    TraceReport trace(const RayBatch& rays, const Packets& packets, const OneByOne& one_by_one);
    [[nodiscard]] bool in_packets(const RayBatch& rays) const;
    /// nullptr where the batch's own order will do.
    [[nodiscard]] const SortedRays* sorted(const RayBatch& rays);

    Traversal traversal_;
    rebuild::GridBuilder builder_;
    rebuild::TriangleView triangles_;
    ResumedRays resumed_;
    RaySort ray_sort_;
};

}  // namespace gridreel::traversal
