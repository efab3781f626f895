#pragma once
// Triangle meshes as binary PLY (Turk 1994).

#include <glm/vec3.hpp>

#include <filesystem>
#include <span>

namespace gridreel::sequences {

/// Writes `binary_little_endian 1.0`: element `vertex` with float x y z, then nx ny nz when there are
/// normals; element `face` with `property list uchar uint vertex_indices`, three indices each.
/// The file appears whole or not at all.
///
/// @param normals    empty, or one per position
/// @param triangles  into `positions`
/// @throws OutputError naming the file
void write_ply(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
               std::span<const glm::uvec3> triangles, const std::filesystem::path& file);

}  // namespace gridreel::sequences
