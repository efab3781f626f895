#pragma once
// Diffuse bounces: rays that leave surfaces every which way, the hardest for a tracer.

#include "engine/surface.h"
#include "traversal/ray_batch.h"

#include <cstddef>
#include <cstdint>

namespace gridreel::engine {

/// Sets ray `index` to leave the surface with the cosine's density about its geometric normal, as light
/// leaves a Lambert surface: the direction is the normal plus a point of the unit sphere.
///
/// @param seed  another one, another direction; the same one, the same
/// @param rays  without a common origin or direction
void set_bounce_ray(const SurfaceShape& surface, std::uint32_t seed, std::size_t index,
                    traversal::RayBatch& rays);

}  // namespace gridreel::engine
