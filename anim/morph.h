#pragma once
// Morph targets: a primitive's shape before joints and nodes place it (glTF 2.0, section 3.7.2.2).
//
// Each function writes the morphed attribute of the vertices [first, first + out.size()):
// the file's value plus, target after target, weight times displacement. Targets that weigh nothing
// are passed over.

#include "anim/scene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <span>

namespace gridreel::anim {

/// @param weights  one per target of `primitive`, or empty when it has none
/// @param centre   subtracted from the file's positions
void morph_positions(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                     const glm::vec3& centre, std::span<glm::vec3> out);

/// Not normalised: whatever maps the normals afterwards must do that anyway.
/// `primitive` has normals.
void morph_normals(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                   std::span<glm::vec3> out);

/// xyz as `morph_normals`; w stays the file's. `primitive` has tangents.
void morph_tangents(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                    std::span<glm::vec4> out);

}  // namespace gridreel::anim
