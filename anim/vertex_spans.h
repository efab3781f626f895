#pragma once
// A run of vertices on its way from the file's space into the world.

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>

namespace gridreel::anim {

/// Attributes of consecutive vertices as their primitive has them, or morphed.
struct ShapeSpans {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals{};   ///< of any length; one per position, or empty
    std::span<const glm::vec4> tangents{};  ///< one per position, or empty
    glm::vec3 centre{0.0f};                 ///< to be subtracted from the positions before they are mapped
};

/// Where the same vertices go in the frame: positions in the world, normals and tangents at unit length.
/// May be the shape's own memory, span by span.
struct VertexSpans {
    std::span<glm::vec3> positions;
    std::span<glm::vec3> normals{};   ///< one per position, or empty
    std::span<glm::vec4> tangents{};  ///< one per position, or empty
};

}  // namespace gridreel::anim
