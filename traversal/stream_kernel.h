#pragma once
// Incoherent rays through the grid, a few at a time, each on its own way.

#include "traversal/cell_digest.h"
#include "traversal/grid_scene.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

#include <cstddef>

namespace gridreel::traversal {

/// Closest hits of rays [begin, end).
TraceReport closest_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                               const ResumedRays& resumed, std::size_t begin, std::size_t end,
                               HitBatch& hits);

/// Whether anything blocks rays [begin, end); each walk ends at its first hit.
TraceReport any_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                           const ResumedRays& resumed, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded);

}  // namespace gridreel::traversal
