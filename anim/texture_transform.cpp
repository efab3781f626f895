#include "anim/texture_transform.h"

#include <cmath>

namespace gridreel::anim {

glm::vec2 TextureTransform::apply(const glm::vec2& texcoord) const {
    const glm::vec2 scaled = scale * texcoord;
    if (rotation_rad == 0.0f) return scaled + offset;
    const float c = std::cos(rotation_rad);
    const float s = std::sin(rotation_rad);
    return glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x) + offset;
}

}  // namespace gridreel::anim
