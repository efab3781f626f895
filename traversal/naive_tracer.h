#pragma once
// Every triangle for every ray: the oracle of all other tracers, and the survey's baseline.

#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

namespace gridreel::traversal {

/// Tests all triangles against each ray, in ascending order. Triangles are copied corner by corner at
/// rebuild.
class NaiveTracer final : public Tracer {
public:
    rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) override;
    TraceReport closest_hits(const RayBatch& rays, HitBatch& hits) override;
    TraceReport any_hits(const RayBatch& rays, OcclusionBatch& occluded) override;

private:
    rebuild::TriangleView triangles_;
    ResumedRays resumed_;
    rebuild::Buffer<float> corners_;  ///< 9 runs of `padded_count` floats: x, y, z of A, B, C
};

}  // namespace gridreel::traversal
