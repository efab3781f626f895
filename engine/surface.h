#pragma once
// What shading and further rays need to know about a point that a camera ray hit.

#include "engine/brdf.h"
#include "engine/hit_point.h"
#include "engine/posed_scene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace gridreel::engine {

/// A visible point, without its looks. Normals are unit and on the viewer's side of the surface.
struct SurfaceShape {
    glm::vec3 position{0.0f};          ///< on the triangle, world space, metres
    glm::vec3 smooth_position{0.0f};   ///< on the curved surface that the vertex normals suggest
    glm::vec3 geometric_normal{0.0f};  ///< the triangle's
    glm::vec3 normal{0.0f};            ///< interpolated between vertices where the part is smooth
    float coordinate = 0.0f;           ///< largest absolute coordinate of the triangle's corners, metres
    float slimness = 1.0f;             ///< product of two of the triangle's edges over twice its area, >= 1
};

/// A visible point with its material.
struct Surface : SurfaceShape {
    Reflectance reflectance{};
    glm::vec3 emission{0.0f};  ///< radiance, linear RGB
    bool unlit = false;        ///< shows its emission, whatever light falls on it
};

/// @param triangle  hit by `ray` at `point`
[[nodiscard]] SurfaceShape shape_at(const anim::FrameGeometry& geometry, std::uint32_t triangle,
                                    const HitPoint& point, const Ray& ray);

/// @param triangle    hit by `ray` at `point`
/// @param cone_width  how wide the ray stands for at the hit, metres: the pixel's share of the surface,
///                    which chooses the size of textures (Akenine-Möller et al., "Texture Level of Detail
///                    Strategies for Real-Time Ray Tracing", Ray Tracing Gems, 2019)
[[nodiscard]] Surface surface_at(const PosedScene& scene, std::uint32_t triangle, const HitPoint& point,
                                 const Ray& ray, float cone_width);

/// The surface's end of a shadow ray.
struct ShadowEnd {
    glm::vec3 point{0.0f};  ///< just off the surface, on the viewer's side
    float gap = 0.0f;       ///< share of the way from the light to `point` that the ray leaves out at its end
};

/// An end that rounding cannot bring to the wrong side of the surface.
///
/// What the depth of a hit may be off by (traversal/rounding.h) grows as the triangle is a sliver or lit at a
/// low angle, until the tracer computes it in double precision. A light before the surface: the ray ends so
/// much earlier. A light behind it, that only the interpolated normal faces: the point stands so much
/// higher, so that the ray passes through the surface well before its end and finds itself shadowed.
///
/// @param distance  to the light, metres; 0 for one without a place
/// @param cosine    between the way to the light and the geometric normal
[[nodiscard]] ShadowEnd shadow_end(const SurfaceShape& surface, float distance, float cosine);

}  // namespace gridreel::engine
