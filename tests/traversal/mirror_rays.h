#pragma once
// Rays that neighbours leave in nearly the same direction, but from places of their own.

#include "test_rays.h"

#include <cstddef>
#include <vector>

namespace gridreel::tests {

/// Rays of a square picture as they leave a flat mirror behind the triangles.
traversal::RayBatch flat_mirror(const Triangles& triangles, int side);

/// The ways in which packets without common origin or direction can go wrong; about `count` rays each.
std::vector<NamedRays> mirror_batches(const Triangles& triangles, std::size_t count);

}  // namespace gridreel::tests
