#pragma once
// The inner loop of skinning, chosen for the machine's SIMD instructions at run time.

#include "anim/placement.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::anim {

/// Consecutive vertices of one skin, and the maps that carry them.
struct SkinBlock {
    static constexpr std::size_t most = 64;  ///< vertices: their maps stay in the first-level cache
    /// Kernels load and store whole registers: so many vertices behind the last may be touched.
    static constexpr std::size_t padding = 16;

    std::size_t count = 0;                            ///< vertices, at most `most`
    std::array<glm::vec3, most + padding> positions;  ///< relative to `Placement::centre`; then in the world
    std::array<glm::vec3, most + padding> normals;    ///< looked at when `has_normals`
    bool has_normals = false;
    std::array<std::array<glm::vec4, most + padding>, 3> rows;  ///< of each vertex's own map
};

/// Blends every vertex's map from its joints' (glTF 2.0, section 3.7.3.3) and carries position and normal.
/// The same bits with every instruction set: no products are fused.
///
/// @param rows    one per joint of the skin
/// @param joints  `per_vertex` for each vertex of the block, and as many weights
/// @param block   positions and normals in and out; `rows` out. Normals that lose their direction become
/// zero.
void skin(const AffineRows* rows, const std::uint16_t* joints, const float* weights, std::size_t per_vertex,
          const glm::vec3& origin, SkinBlock& block);

}  // namespace gridreel::anim
