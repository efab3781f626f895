#pragma once
// Whether a ray stops where it meets a triangle.

#include "engine/hit_point.h"
#include "engine/posed_scene.h"

#include <cstdint>

namespace gridreel::engine {

enum class RayKind { camera, shadow };

/// Whether a ray that meets the triangle there goes on behind it: through the cut-out parts of a MASK
/// material; and, for the camera only, through the back of a single-sided one. Cut-outs are
/// looked up in the texture's finest size, since in smaller ones they would shrink with distance.
[[nodiscard]] bool lets_through(const PosedScene& scene, std::uint32_t triangle, const Ray& ray,
                                RayKind kind);

}  // namespace gridreel::engine
