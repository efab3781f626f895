#pragma once
// Whether a ray stops where it meets a triangle, or sees through it.

#include "engine/hit_point.h"
#include "engine/posed_scene.h"

#include <cstdint>

namespace gridreel::engine {

enum class RayKind { camera, shadow };

/// Whether a ray that meets the triangle stops there. Rays go on through the cut-out parts of a MASK
/// material; and, the camera's only, through the back of a single-sided one. Cut-outs are looked up in the
/// texture's finest size, since in smaller ones they would shrink with distance.
[[nodiscard]] bool stops_at(const PosedScene& scene, std::uint32_t triangle, const Ray& ray, RayKind kind);

}  // namespace gridreel::engine
