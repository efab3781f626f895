#pragma once
// Whether a ray stops where it meets a triangle, or sees through it.

#include "engine/hit_point.h"
#include "engine/posed_scene.h"

#include <cstdint>

namespace gridreel::engine {

enum class RayKind { camera, shadow };

/// Where a ray stops that meets the triangle: there; or at its twin, when only that one shows its front; or
/// not at all (`traversal::no_triangle`). Rays go on through the cut-out parts of a MASK material; and, the
/// camera's only, through the back of a single-sided one. Cut-outs are looked up in the texture's
/// finest size, since in smaller ones they would shrink with distance.
[[nodiscard]] std::uint32_t stopping_triangle(const PosedScene& scene, std::uint32_t triangle, const Ray& ray,
                                              RayKind kind);

}  // namespace gridreel::engine
