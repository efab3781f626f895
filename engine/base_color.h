#pragma once
// What the textures and vertex colours of a material say at a point.

#include "engine/hit_point.h"
#include "engine/posed_scene.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <optional>

namespace gridreel::engine {

/// A point of a triangle and how much around it counts.
struct TexturedPoint {
    std::uint32_t triangle = 0;
    const HitPoint& point;
    float width =
        0.0f;  ///< of what is looked at, measured on the surface, metres; 0: textures at their finest
};

/// A texture's linear value there; white without a texture.
[[nodiscard]] glm::vec4 textured(const PosedScene& scene, const TexturedPoint& at,
                                 const std::optional<anim::TextureRef>& ref, Encoding encoding);

/// Base colour and alpha: factor times texture times vertex colour (glTF 2.0, section 3.9.2). Linear.
[[nodiscard]] glm::vec4 base_color(const PosedScene& scene, const TexturedPoint& at);

}  // namespace gridreel::engine
