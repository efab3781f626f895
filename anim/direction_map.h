#pragma once
// How normals and tangents go with a linear map.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace gridreel::anim {

/// A linear map's effect on directions. Matrices are kept by rows, so `direction * rows` applies them.
struct DirectionMap {
    glm::mat3 tangent_rows{1.0f};  ///< the map itself
    glm::mat3 normal_rows{1.0f};   ///< its inverse transpose, up to a positive factor
    float handedness = 1.0f;       ///< -1 when the map mirrors, which turns tangent frames inside out
};

/// The inverse transpose is taken as the cofactor matrix, turned round when the map mirrors: the same
/// up to a positive factor, and still defined where the map flattens space and has no inverse.
///
/// @param rows  the linear map, row by row
[[nodiscard]] DirectionMap direction_map(const glm::dmat3& rows);
[[nodiscard]] DirectionMap direction_map(const glm::mat3& rows);

/// The mapped normal at unit length. Where a flattening map leaves no direction: the normal of the plane it
/// flattens onto, or, when even that is lost, +z. Never NaN.
[[nodiscard]] glm::vec3 map_normal(const DirectionMap& map, const glm::vec3& normal);

/// The mapped tangent at unit length; +x where the map leaves no direction. Never NaN.
[[nodiscard]] glm::vec3 map_tangent(const DirectionMap& map, const glm::vec3& tangent);

}  // namespace gridreel::anim
