#pragma once
// Batches of rays to trace with: pleasant and nasty.

#include "rebuild/bounds.h"
#include "test_triangles.h"
#include "traversal/ray_batch.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace gridreel::tests {

struct NamedRays {
    std::string name;
    traversal::RayBatch rays;
};

rebuild::Bounds3 finite_bounds(const Triangles& triangles);

/// A square picture of `side` * `side` rays along the Morton curve, from `eye` towards `target`.
traversal::RayBatch pinhole(const glm::vec3& eye, const glm::vec3& target, float half_angle_tan, int side);

/// Rays from one point in all directions, in no order.
traversal::RayBatch from_point(const glm::vec3& point, std::size_t count, std::uint64_t seed);

/// Shadow rays: from one point to random points of the triangles, ending just before them.
traversal::RayBatch towards_surfaces(const glm::vec3& point, const Triangles& triangles, std::size_t count);

/// A square picture of `side` * `side` rays along the Morton curve that all run the way of `direction`,
/// through a square about `middle` from -half to half.
traversal::RayBatch orthographic(const glm::vec3& middle, const glm::vec3& direction, float half, int side);

/// A sun's shadow rays: from random points of the triangles, and from just beside them.
traversal::RayBatch from_surfaces(const glm::vec3& direction, const Triangles& triangles, std::size_t count);

/// Every batch that tracers must agree on, for these triangles; about `count` rays each.
std::vector<NamedRays> nasty_batches(const Triangles& triangles, std::size_t count);

}  // namespace gridreel::tests
