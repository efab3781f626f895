#pragma once
// Taking strips and fans apart.

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gridreel::anim::gltf {

/// `mode` of a primitive, as in the file.
enum class Topology { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

[[nodiscard]] bool has_triangles(Topology topology);

/// Whether `index_count` is a valid number of indices: a multiple of three, or at least three.
[[nodiscard]] bool is_whole(Topology topology, std::size_t index_count);

/// The triangles in the order and winding of glTF 2.0, section 3.7.2.1; degenerate ones are kept.
/// Indices left over at the end make no triangle.
///
/// @param topology  one that has triangles
[[nodiscard]] std::vector<glm::uvec3> assemble_triangles(Topology topology,
                                                         std::span<const std::uint32_t> indices);

}  // namespace gridreel::anim::gltf
