#pragma once
// Morph targets: a primitive's shape before joints and nodes place it (glTF 2.0, section 3.7.2.2).

#include "anim/scene.h"
#include "anim/vertex_spans.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>

namespace gridreel::anim {

/// The shape of consecutive vertices: the file's values plus, target after target, weight times displacement.
/// Attributes that no target displaces are the file's own, without a copy; the others are written to `room`.
/// Targets that weigh nothing are passed over. Normals and tangents are not brought to unit length: whatever
/// maps them afterwards must do that anyway. A tangent's w stays the file's.
///
/// @param weights  one per target of `primitive`, or empty when it has none
/// @param first    the first vertex
/// @param centre   of `Placement`: displaced positions come relative to it, others with it still to subtract
/// @param room     one per vertex of each attribute that is asked for; `primitive` has it
[[nodiscard]] ShapeSpans morph(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                               const glm::vec3& centre, const VertexSpans& room);

}  // namespace gridreel::anim
