#pragma once
// A part's transforms of one frame, rounded to float without losing the digits of models that stand far
// from the origin of their file or of the world.

#include "anim/direction_map.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <span>

namespace gridreel::anim {

/// An affine map as three rows: linear part, offset. A fourth that nobody looks at fills the cache line, so
/// that kernels load a map as one register, or two.
struct alignas(64) AffineRows {
    std::array<glm::vec4, 4> row{};
};

/// How a part's vertices get into the world. A file position p becomes
///     origin + (sum over its joints of weight * rows[joint]) applied to (p - centre)
/// and a rigid part has one joint. Both p - centre and the sum are about as small as the part itself.
struct Placement {
    glm::vec3 centre{0.0f};     ///< middle of the primitive's box in the file; the same every frame
    glm::vec3 origin{0.0f};     ///< mean of where the joints take `centre`, metres
    DirectionMap directions{};  ///< of a rigid part; a skinned one has its own at every vertex
    bool mirrored = false;      ///< the map, or most joints of the skin, have a negative determinant
};

/// Middle of the box of all finite positions; zero when there are none.
[[nodiscard]] glm::vec3 centre_of(std::span<const glm::vec3> positions);

/// Rounds `maps` about `placement.centre`: fills `rows` (as many) and the rest of `placement`.
///
/// @param maps  affine, from the file's space to the world: one per joint, or the node's own; at least one
void round_maps(std::span<const glm::dmat4> maps, Placement& placement, std::span<AffineRows> rows);

}  // namespace gridreel::anim
