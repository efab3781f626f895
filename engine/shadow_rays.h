#pragma once
// Rays between a light and the points it may light.

#include "engine/lights.h"
#include "engine/surface.h"
#include "traversal/ray_batch.h"

#include <cstddef>

namespace gridreel::engine {

/// Whether light arrives on the viewer's side of the surface, if nothing is in its way.
[[nodiscard]] bool may_light(const PosedLight& light, const SurfaceShape& surface);

/// Makes room for `count` rays. A light with a place is their common origin; those of a directional light
/// begin at the surfaces and have their direction in common. Either way the tracer sorts them into packets.
void begin_shadow_rays(const PosedLight& light, std::size_t count, traversal::RayBatch& rays);

/// Sets ray `index` of a batch begun for the light. Whatever it hits keeps the light from the surface.
void set_shadow_ray(const PosedLight& light, const SurfaceShape& surface, std::size_t index,
                    traversal::RayBatch& rays);

}  // namespace gridreel::engine
