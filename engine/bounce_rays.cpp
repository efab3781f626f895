#include "engine/bounce_rays.h"

#include "engine/ray_offset.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace gridreel::engine {
namespace {

/// PCG's output function over a linear congruence (Jarzynski & Olano, "Hash Functions for GPU Rendering",
/// JCGT 9(3), 2020).
std::uint32_t hash(std::uint32_t value) {
    const std::uint32_t state = value * 747'796'405u + 2'891'336'453u;
    const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277'803'737u;
    return (word >> 22u) ^ word;
}

float unit_interval(std::uint32_t bits) {
    return static_cast<float>(bits >> 8u) * 0x1p-24f;
}

/// A point of the unit sphere, uniformly distributed over seeds (Archimedes: its height is uniform).
glm::vec3 on_sphere(std::uint32_t seed) {
    const float z = 1.0f - 2.0f * unit_interval(hash(2 * seed));
    const float angle = 2.0f * std::numbers::pi_v<float> * unit_interval(hash(2 * seed + 1));
    const float radius = std::sqrt(std::fmax(0.0f, 1.0f - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

void set_bounce_ray(const SurfaceShape& surface, std::uint32_t seed, std::size_t index,
                    traversal::RayBatch& rays) {
    const glm::vec3 lobe = surface.geometric_normal + on_sphere(seed);
    const float length = glm::length(lobe);
    // Almost opposite points leave no direction.
    const glm::vec3 direction = length > 1e-3f ? lobe / length : surface.geometric_normal;
    rays.set_origin(index,
                    surface.position + ray_offset(surface.coordinate, 0.0f) * surface.geometric_normal);
    rays.set_direction(index, direction);
    rays.t_min[index] = 0.0f;
    rays.t_max[index] = std::numeric_limits<float>::infinity();
}

}  // namespace gridreel::engine
