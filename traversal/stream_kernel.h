#pragma once
// Incoherent rays through the grid, a few at a time, each on its own way.

#include "traversal/cell_digest.h"
#include "traversal/grid_scene.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace gridreel::traversal {

/// Which rays of a batch are still `undecided`; empty: all are.
using Unanswered = std::span<const std::uint8_t>;

/// Closest hits of those rays in [begin, end) that are left.
TraceReport closest_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                               const ResumedRays& resumed, Unanswered left, std::size_t begin,
                               std::size_t end, HitBatch& hits);

/// Whether anything blocks those rays; each walk ends at its first hit.
TraceReport any_in_streams(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                           const ResumedRays& resumed, Unanswered left, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded);

}  // namespace gridreel::traversal
