#pragma once
// Where in a texture a texture coordinate looks.

#include <glm/vec2.hpp>

namespace gridreel::anim {

/// KHR_texture_transform.
struct TextureTransform {
    glm::vec2 offset{0.0f};
    float rotation_rad = 0.0f;
    glm::vec2 scale{1.0f};

    /// The coordinate scaled, then rotated about the texture's top left corner, then moved. A positive
    /// rotation goes counter-clockwise as one sees the image, whose v points down: (1, 0) turns towards
    /// (0, -1). So say the extension's table, its example and Khronos' test models; its listing in GLSL has
    /// the other sign (KhronosGroup/glTF, issue 1563).
    [[nodiscard]] glm::vec2 apply(const glm::vec2& texcoord) const;
};

}  // namespace gridreel::anim
