#pragma once
// The inner loop of skinning, chosen for the machine's SIMD instructions at run time.

#include "anim/placement.h"
#include "anim/scene.h"
#include "anim/vertex_spans.h"

#include <cstddef>
#include <span>

namespace gridreel::anim {

/// Carries every vertex with the weighted sum of its joints' maps (glTF 2.0, section 3.7.3.3), normals and
/// tangents as direction_map.h says. The same bits with every instruction set.
///
/// @param maps   one per joint of the skin
/// @param first  which vertex of `influences` the spans begin with
/// @param from   has what `to` has
void place_skinned(const Placement& placement, std::span<const AffineRows> maps, const Influences& influences,
                   std::size_t first, const ShapeSpans& from, const VertexSpans& to);

}  // namespace gridreel::anim
