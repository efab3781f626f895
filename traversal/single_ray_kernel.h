#pragma once
// Rays through the grid one at a time: what coherent traversal is measured against, and the way of rays
// that have neither origin nor direction in common.

#include "traversal/grid_scene.h"
#include "traversal/occupied_cells.h"
#include "traversal/reference_boxes.h"
#include "traversal/resumed_rays.h"
#include "traversal/tracer.h"

#include <cstddef>

namespace gridreel::traversal {

/// What single rays ask about cells before they read the lists.
struct CellDigest {
    const OccupiedCells& occupied;
    const ReferenceBoxes* boxes = nullptr;  ///< none: too few rays to be worth it
};

/// Closest hits of rays [begin, end), by 3D-DDA with mailboxing.
TraceReport closest_one_by_one(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                               const ResumedRays& resumed, std::size_t begin, std::size_t end,
                               HitBatch& hits);

/// Whether anything blocks rays [begin, end); each walk ends at its first hit.
TraceReport any_one_by_one(const GridScene& scene, const CellDigest& cells, const RayBatch& rays,
                           const ResumedRays& resumed, std::size_t begin, std::size_t end,
                           OcclusionBatch& occluded);

}  // namespace gridreel::traversal
