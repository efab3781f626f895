#include "mirror_rays.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace gridreel::tests {
namespace {

using traversal::RayBatch;
using traversal::RayOrder;

/// The same rays without anything in common: `change(i, origin, direction)` may turn each.
template <class Change>
RayBatch loosened(const RayBatch& rays, const Change& change) {
    RayBatch loose;
    loose.resize(rays.size(), std::nullopt, RayOrder::coherent);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        glm::vec3 origin = rays.origin_of(i), direction = rays.direction_of(i);
        loose.t_min[i] = rays.t_min[i];
        loose.t_max[i] = rays.t_max[i];
        change(i, origin, direction);
        loose.set_origin(i, origin);
        loose.set_direction(i, direction);
    }
    return loose;
}

/// A ball between the eye and `middle`, curved outwards or, seen from within, inwards.
RayBatch curved_mirror(const RayBatch& rays, const glm::vec3& middle, float radius, bool inwards) {
    return loosened(rays, [&](std::size_t, glm::vec3& origin, glm::vec3& direction) {
        const glm::vec3 d = glm::normalize(direction), to = middle - origin;
        const float along = glm::dot(to, d), root = along * along - glm::dot(to, to) + radius * radius;
        if (!(root > 0.0f)) return;
        origin += d * (along + (inwards ? 1.0f : -1.0f) * std::sqrt(root));
        const glm::vec3 normal = (origin - middle) / radius;
        direction = d - 2.0f * glm::dot(d, normal) * normal;
    });
}

/// Rays that pass `focus` from a disc: their hull narrows, and widens again.
RayBatch through_focus(const glm::vec3& focus, const glm::vec3& way, float width, std::size_t count) {
    RayBatch rays;
    rays.resize(count, std::nullopt, RayOrder::arbitrary);
    Random random(31);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = focus - way + width * random.in_box(-1.0f, 1.0f);
        rays.set_origin(i, origin);
        rays.set_direction(i, focus - origin);
        rays.t_min[i] = 0.0f;
        rays.t_max[i] = std::numeric_limits<float>::infinity();
    }
    return rays;
}

/// Every kind of ray that ends early, begins late or can hit nothing, among others that are well.
void spoil(RayBatch& rays, float length) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Random random(32);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const float per_metre = 1.0f / glm::length(rays.direction_of(i));
        rays.t_min[i] = random.uniform(-0.1f, 0.4f) * length * per_metre;
        rays.t_max[i] = rays.t_min[i] + random.uniform(0.0f, 1.0f) * length * per_metre;
        if (i % 90 == 0) rays.set_direction(i, glm::vec3{0.0f});
        if (i % 90 == 17) rays.set_origin(i, glm::vec3{std::numeric_limits<float>::quiet_NaN()});
        if (i % 90 == 33) rays.t_max[i] = rays.t_min[i];
        if (i % 90 == 51) rays.set_direction(i, {infinity, 0.0f, 1.0f});
        if (i % 90 == 70) rays.set_origin(i, {1e20f, 0.0f, 0.0f});
    }
}

/// Runs of `run` rays of each batch in turn.
RayBatch in_turns(const RayBatch& a, const RayBatch& b, std::size_t run) {
    return loosened(a, [&](std::size_t i, glm::vec3& origin, glm::vec3& direction) {
        if (i / run % 2 == 0 || i >= b.size()) return;
        origin = b.origin_of(i);
        direction = b.direction_of(i);
    });
}

}  // namespace

RayBatch flat_mirror(const Triangles& triangles, int side) {
    const rebuild::Bounds3 box = finite_bounds(triangles);
    const glm::vec3 middle = 0.5f * (box.min + box.max);
    const float length = glm::length(box.extent()), back = box.min.z - 0.1f * length;
    const RayBatch rays = pinhole(middle + length * glm::vec3{0.1f, 0.2f, 0.9f}, middle, 0.3f, side);
    return loosened(rays, [&](std::size_t, glm::vec3& origin, glm::vec3& direction) {
        if (!(direction.z < 0.0f)) return;
        origin += direction * ((back - origin.z) / direction.z);
        direction.z = -direction.z;
    });
}

std::vector<NamedRays> mirror_batches(const Triangles& triangles, std::size_t count) {
    const rebuild::Bounds3 box = finite_bounds(triangles);
    const glm::vec3 size = box.extent(), middle = box.min + 0.5f * size;
    const float length = glm::length(size);
    const int side = static_cast<int>(std::sqrt(double(count)));
    const RayBatch picture = pinhole(middle + length * glm::vec3{-0.9f, 0.3f, 0.2f}, middle, 0.4f, side);
    const RayBatch parallel =
        orthographic(middle - length * glm::vec3{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 2.0f}, 0.3f * length, side);
    const RayBatch far_away =
        pinhole(middle + length * glm::vec3{300.0f, 100.0f, -50.0f}, middle, 0.001f, side);
    const RayBatch within = pinhole(middle, middle + glm::vec3{0.3f, 0.2f, 1.0f}, 0.7f, side);
    Random random(33);
    const auto lens = [&](float width) {
        return [&random, width](std::size_t, glm::vec3& origin, glm::vec3&) {
            origin += width * random.in_box(-1.0f, 1.0f);
        };
    };

    std::vector<NamedRays> batches;
    batches.push_back({"flat mirror", flat_mirror(triangles, side)});
    batches.push_back({"ball mirror", curved_mirror(picture, middle, 0.3f * length, false)});
    batches.push_back({"hollow mirror", curved_mirror(within, middle, 0.6f * length, true)});
    batches.push_back({"through a lens", loosened(picture, lens(0.02f * length))});
    batches.push_back({"through a lens, from inside", loosened(within, lens(1e-4f * length))});
    batches.push_back({"along an axis, each on its own", loosened(parallel, lens(0.0f))});
    batches.push_back({"through a lens, from far away", loosened(far_away, lens(0.01f * length))});
    batches.push_back(
        {"through a focus in the box",
         through_focus(middle + 0.1f * size, length * glm::vec3{0.1f, -0.8f, 0.2f}, 0.05f * length, count)});
    batches.push_back({"mirrors and lenses in turns", in_turns(batches[1].rays, batches[4].rays, 100)});
    batches.push_back({"mirror, bounded", flat_mirror(triangles, side)});
    spoil(batches.back().rays, length);
    batches.push_back({"lens, bounded", loosened(within, lens(1e-3f * length))});
    spoil(batches.back().rays, length);
    return batches;
}

}  // namespace gridreel::tests
