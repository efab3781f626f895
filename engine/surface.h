#pragma once
// What shading needs to know about a point that a camera ray hit.

#include "engine/brdf.h"
#include "engine/hit_point.h"
#include "engine/posed_scene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace gridreel::engine {

/// A visible point with its material. Normals are unit and on the viewer's side of the surface.
struct Surface {
    glm::vec3 position{0.0f};          ///< on the triangle, world space, metres
    glm::vec3 smooth_position{0.0f};   ///< on the curved surface that the vertex normals suggest
    glm::vec3 geometric_normal{0.0f};  ///< the triangle's
    glm::vec3 normal{0.0f};            ///< interpolated between vertices where the part is smooth
    Reflectance reflectance{};
    glm::vec3 emission{0.0f};  ///< radiance, linear RGB
    float coordinate = 0.0f;   ///< largest absolute coordinate of the triangle's corners, metres
    float slimness = 1.0f;     ///< product of two of the triangle's edges over twice its area, >= 1
};

/// @param triangle    hit by `ray` at `point`
/// @param cone_width  how wide the ray stands for at the hit, metres: the pixel's share of the surface,
///                    which chooses the size of textures (Akenine-Möller et al., "Texture Level of Detail
///                    Strategies for Real-Time Ray Tracing", Ray Tracing Gems, 2019)
[[nodiscard]] Surface surface_at(const PosedScene& scene, std::uint32_t triangle, const HitPoint& point,
                                 const Ray& ray, float cone_width);

/// Where shadow rays towards a light meet the surface: off it by what rounding may cost, on the viewer's
/// side.
/// @param distance  to the light, metres; 0 for one without a place
[[nodiscard]] glm::vec3 shadow_point(const Surface& surface, float distance);

/// The share of the way from a light to `shadow_point` that a shadow ray leaves out at its end: what the
/// depth of a hit may be off by (traversal/rounding.h), which grows as the triangle is a sliver or lit at a
/// low angle, until the tracer computes it in double precision.
/// @param cosine  between the way to the light and the geometric normal
[[nodiscard]] float shadow_gap(const Surface& surface, float cosine);

}  // namespace gridreel::engine
