#pragma once
// The inner loop of rigid parts, chosen for the machine's SIMD instructions at run time.

#include "anim/placement.h"
#include "anim/vertex_spans.h"

namespace gridreel::anim {

/// Carries every vertex with the one map of its part, normals and tangents with `placement.directions`.
/// The same bits with every instruction set.
///
/// @param from  has what `to` has
void place_rigid(const Placement& placement, const AffineRows& map, const ShapeSpans& from,
                 const VertexSpans& to);

}  // namespace gridreel::anim
