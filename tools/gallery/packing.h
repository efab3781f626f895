#pragma once
// Numbers into accessors, in the smallest component type that glTF allows for them.

#include "tools/gallery/document.h"

#include <glm/gtc/type_precision.hpp>
#include <glm/vec4.hpp>

#include <span>

namespace gridreel::gallery {

/// Positions or displacements: float32, with min and max.
[[nodiscard]] Id add_positions(Document& document, std::span<const glm::vec3> positions);

/// Normals, unit, or their displacements: float32.
[[nodiscard]] Id add_normals(Document& document, std::span<const glm::vec3> normals);

/// Linear RGBA: normalised bytes.
[[nodiscard]] Id add_colors(Document& document, std::span<const glm::u8vec4> colors);

/// Joint numbers, < 256: bytes.
[[nodiscard]] Id add_joints(Document& document, std::span<const glm::u8vec4> joints);

/// Skin weights, each vertex summing to 65535: normalised 16-bit.
[[nodiscard]] Id add_weights(Document& document, std::span<const glm::u16vec4> weights);

/// Triangles: 16-bit indices below 65535 vertices, 32-bit from there on.
[[nodiscard]] Id add_indices(Document& document, std::span<const glm::uvec3> triangles,
                             std::size_t vertex_count);

/// Column-major 4x4 matrices of translations: float32.
[[nodiscard]] Id add_translation_matrices(Document& document, std::span<const glm::dvec3> translations);

/// Key times in seconds, strictly increasing: float32, with min and max.
[[nodiscard]] Id add_times(Document& document, std::span<const float> times_s);

/// One vector per key: float32.
[[nodiscard]] Id add_translation_keys(Document& document, std::span<const glm::dvec3> keys);

/// One unit quaternion per key: normalised 16-bit, signs chosen so that neighbours are near.
[[nodiscard]] Id add_rotation_keys(Document& document, std::span<const glm::dquat> keys);

/// Moves a node from place to place, one per key.
/// @param times  from `add_times`
void animate_translation(Document& document, Id node, Id times, std::span<const glm::dvec3> places);

/// Turns a node, one rotation per key.
/// @param times  from `add_times`
void animate_rotation(Document& document, Id node, Id times, std::span<const glm::dquat> rotations);

/// Scalars, as weights animation wants them: float32.
[[nodiscard]] Id add_scalars(Document& document, std::span<const float> values);

}  // namespace gridreel::gallery
