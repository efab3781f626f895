#pragma once
// The vertex loops: from a part's own space into the world, in place.

#include "anim/placement.h"
#include "anim/scene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <span>

namespace gridreel::anim {

/// Attributes of consecutive vertices of one part. Positions are relative to `Placement::centre` on
/// the way in and in the world on the way out; normals and tangents come out at unit length.
struct VertexSpans {
    std::span<glm::vec3> positions;
    std::span<glm::vec3> normals{};   ///< one per position, or empty
    std::span<glm::vec4> tangents{};  ///< one per position, or empty
};

/// Carries all vertices with one map.
void transform_rigid(const Placement& placement, const AffineRows& rows, const VertexSpans& vertices);

/// Carries every vertex with the weighted sum of its joints' maps (glTF 2.0, section 3.7.3.3).
///
/// @param rows   one per joint of the skin
/// @param first  which vertex of `influences` the spans begin with
void transform_skinned(const Placement& placement, std::span<const AffineRows> rows,
                       const Influences& influences, std::size_t first, const VertexSpans& vertices);

}  // namespace gridreel::anim
