#include "test_rays.h"

#include "mirror_rays.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace gridreel::tests {
namespace {

using traversal::RayBatch;
using traversal::RayOrder;

constexpr float infinity = std::numeric_limits<float>::infinity();

void set_ray(RayBatch& rays, std::size_t i, const glm::vec3& direction, float t_min = 0.0f,
             float t_max = infinity) {
    rays.set_direction(i, direction);
    rays.t_min[i] = t_min;
    rays.t_max[i] = t_max;
}

void set_parallel_ray(RayBatch& rays, std::size_t i, const glm::vec3& origin, float t_min = 0.0f,
                      float t_max = infinity) {
    rays.set_origin(i, origin);
    rays.t_min[i] = t_min;
    rays.t_max[i] = t_max;
}

bool usable(const Triangles& triangles, const glm::uvec3& t) {
    for (int corner = 0; corner < 3; ++corner) {
        if (!rebuild::is_traceable(triangles.positions[t[corner]])) return false;
    }
    return true;
}

/// A corner, a point of an edge or a point inside of some triangle.
glm::vec3 point_of(const Triangles& triangles, Random& random) {
    for (;;) {
        const glm::uvec3& t = triangles.triangles[random.next() % triangles.triangles.size()];
        if (!usable(triangles, t)) continue;
        const glm::vec3 &a = triangles.positions[t.x], &b = triangles.positions[t.y],
                        &c = triangles.positions[t.z];
        const float u = random.uniform(0.0f, 1.0f), v = random.uniform(0.0f, 1.0f - u);
        switch (random.next() % 4) {
            case 0:
                return a;
            case 1:
                return 0.5f * (a + b);
            case 2:
                return a + u * (b - a);
            default:
                return a + u * (b - a) + v * (c - a);
        }
    }
}

RayBatch scattered(std::size_t count) {
    RayBatch rays;
    rays.resize(count, std::nullopt, RayOrder::arbitrary);
    return rays;
}

RayBatch random_rays(const rebuild::Bounds3& box, float margin, std::size_t count, std::uint64_t seed) {
    RayBatch rays = scattered(count);
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        rays.set_origin(i, box.min + box.extent() * random.in_box(-margin, 1.0f + margin));
        set_ray(rays, i, random.on_sphere() * random.uniform(0.1f, 10.0f));
    }
    return rays;
}

/// Along one or two axes exactly, from whole fractions of the box: in cell planes and through edges.
RayBatch axis_rays(const rebuild::Bounds3& box, std::size_t count) {
    RayBatch rays = scattered(count);
    Random random(11);
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 part{0.0f};
        for (int axis = 0; axis < 3; ++axis) part[axis] = float(random.next() % 17) / 16.0f;
        glm::vec3 direction{0.0f};
        direction[static_cast<int>(random.next() % 3)] = random.next() % 2 == 0 ? 1.0f : -1.0f;
        if (random.next() % 2 == 0) direction[static_cast<int>(random.next() % 3)] += 1.0f;
        if (direction == glm::vec3{0.0f}) direction.x = -1.0f;
        rays.set_origin(
            i, box.min + box.extent() * part - 2.0f * box.extent() * direction * float(random.next() % 2));
        set_ray(rays, i, direction);
    }
    return rays;
}

/// Through corners and points of edges, from around the box or from other corners.
RayBatch through_features(const Triangles& triangles, const rebuild::Bounds3& box, std::size_t count) {
    RayBatch rays = scattered(count);
    Random random(12);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 target = point_of(triangles, random);
        const bool between = random.next() % 2 == 0;
        const glm::vec3 from =
            between ? point_of(triangles, random) : box.min + box.extent() * random.in_box(-1.0f, 2.0f);
        rays.set_origin(i, from);
        set_ray(rays, i, target - from);
    }
    return rays;
}

/// Calls `ray(i, u, v)` for the pixels of a square picture, u and v from -1 to 1, along the Morton curve:
/// every 16 or 256 in a row are a square.
template <class Ray>
void for_each_pixel(int side, const Ray& ray) {
    const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    std::size_t i = 0;
    for (std::uint32_t code = 0; i < count; ++code) {
        int x = 0, y = 0;
        for (unsigned bit = 0; bit < 15; ++bit) {
            x |= static_cast<int>(code >> (2 * bit) & 1u) << bit;
            y |= static_cast<int>(code >> (2 * bit + 1) & 1u) << bit;
        }
        if (x >= side || y >= side) continue;
        ray(i++, 2.0f * (float(x) + 0.5f) / float(side) - 1.0f,
            2.0f * (float(y) + 0.5f) / float(side) - 1.0f);
    }
}

/// Bounded intervals, and rays that can hit nothing.
RayBatch bounded(const rebuild::Bounds3& box, std::size_t count) {
    RayBatch rays = random_rays(box, 0.2f, count, 13);
    Random random(14);
    const float size = glm::length(box.extent());
    for (std::size_t i = 0; i < count; ++i) {
        rays.t_min[i] = random.uniform(0.0f, 0.1f) * size;
        rays.t_max[i] = rays.t_min[i] + random.uniform(-0.02f, 0.3f) * size;
        if (i % 50 == 0) rays.set_direction(i, glm::vec3{0.0f});
        if (i % 50 == 1) rays.set_direction(i, glm::vec3{std::numeric_limits<float>::quiet_NaN()});
        if (i % 50 == 2) rays.set_direction(i, {infinity, 0.0f, 1.0f});
    }
    return rays;
}

RayBatch bounded_from_point(const glm::vec3& point, const rebuild::Bounds3& box, std::size_t count) {
    RayBatch rays = from_point(point, count, 15);
    Random random(16);
    const float size = glm::length(box.extent());
    for (std::size_t i = 0; i < count; ++i) {
        rays.t_min[i] = random.uniform(0.0f, 0.5f) * size;
        rays.t_max[i] = rays.t_min[i] + random.uniform(-0.1f, 1.0f) * size;
        if (i % 64 == 0) rays.set_direction(i, glm::vec3{0.0f});
        if (i % 64 == 1) rays.set_direction(i, glm::vec3{std::numeric_limits<float>::quiet_NaN()});
    }
    return rays;
}

/// From all over the box and `margin` times its size around it, with bounded intervals and rays that can hit
/// nothing.
RayBatch bounded_parallel(const rebuild::Bounds3& box, const glm::vec3& direction, float margin,
                          std::size_t count) {
    RayBatch rays;
    rays.resize_parallel(count, direction, RayOrder::arbitrary);
    Random random(25);
    const float size = glm::length(box.extent()) / glm::length(direction);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = box.min + box.extent() * random.in_box(-margin, 1.0f + margin);
        const float t_min = random.uniform(-0.1f, 0.3f) * size;
        set_parallel_ray(rays, i, origin, t_min, t_min + random.uniform(-0.1f, 1.0f) * size);
        if (i % 64 == 0) rays.set_origin(i, glm::vec3{std::numeric_limits<float>::quiet_NaN()});
        if (i % 64 == 1) rays.set_origin(i, {0.0f, 1e20f, 0.0f});
        if (i % 64 == 2) rays.t_max[i] = rays.t_min[i];
    }
    return rays;
}

/// From whole fractions of the box, and from far before them: in cell planes and through edges.
RayBatch parallel_from_lattice(const rebuild::Bounds3& box, const glm::vec3& direction, std::size_t count) {
    RayBatch rays;
    rays.resize_parallel(count, direction, RayOrder::arbitrary);
    Random random(26);
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 part{0.0f};
        for (int axis = 0; axis < 3; ++axis) part[axis] = float(random.next() % 17) / 16.0f;
        const float before = 2.0f * float(random.next() % 2);
        set_parallel_ray(rays, i, box.min + box.extent() * (part - before * direction));
    }
    return rays;
}

/// Along one of the triangles' edges, through corners and points of edges: from there, from before and
/// behind.
RayBatch parallel_through_features(const Triangles& triangles, std::size_t count) {
    Random random(27);
    glm::vec3 direction{0.0f};
    while (!(glm::length(direction) > 0.0f)) {
        const glm::uvec3& t = triangles.triangles[random.next() % triangles.triangles.size()];
        if (usable(triangles, t)) direction = triangles.positions[t.y] - triangles.positions[t.x];
    }
    RayBatch rays;
    rays.resize_parallel(count, direction, RayOrder::arbitrary);
    for (std::size_t i = 0; i < count; ++i) {
        const float before = float(random.next() % 7) - 3.0f;
        set_parallel_ray(rays, i, point_of(triangles, random) - before * direction);
    }
    return rays;
}

/// Every `Packet`'s way to go wrong with one direction.
void add_parallel_batches(const Triangles& triangles, const rebuild::Bounds3& box, std::size_t count,
                          std::vector<NamedRays>& batches) {
    const glm::vec3 middle = box.min + 0.5f * box.extent();
    const float length = glm::length(box.extent());
    const glm::vec3 oblique{-0.3f, -0.5f, -1.1f}, steep{0.02f, -3.0f, 0.05f};
    const int side = static_cast<int>(std::sqrt(double(count)));
    batches.push_back(
        {"parallel picture", orthographic(middle - length * oblique, oblique, 0.6f * length, side)});
    batches.push_back({"parallel picture, from inside, close up",
                       orthographic(middle, {1.0f, 0.7f, -0.2f}, 0.05f * length, side)});
    batches.push_back(
        {"parallel picture along an axis", orthographic(middle, {0.0f, 0.0f, -1.0f}, 0.5f * length, side)});
    batches.push_back({"parallel picture from far away",
                       orthographic(middle - 200.0f * length * steep, steep, 0.5f * length, side)});
    batches.push_back({"from surfaces to the sun", from_surfaces(-oblique, triangles, count)});
    batches.push_back(
        {"from surfaces to a sun on an axis", from_surfaces({0.0f, 1.0f, 0.0f}, triangles, count)});
    batches.push_back({"from surfaces to a low sun", from_surfaces({5.0f, 1e-3f, 0.0f}, triangles, count)});
    batches.push_back(
        {"from a lattice along a diagonal", parallel_from_lattice(box, {1.0f, -1.0f, 1.0f}, count)});
    batches.push_back(
        {"from a lattice along an axis", parallel_from_lattice(box, {-1.0f, 0.0f, 0.0f}, count)});
    batches.push_back({"parallel, along edges", parallel_through_features(triangles, count)});
    batches.push_back({"parallel, bounded", bounded_parallel(box, steep, 0.2f, count)});
    batches.push_back({"parallel, bounded, from far", bounded_parallel(box, oblique, 20.0f, count)});
    batches.push_back({"parallel, without a way", bounded_parallel(box, {0.0f, infinity, 1.0f}, 0.2f, 300)});
}

}  // namespace

rebuild::Bounds3 finite_bounds(const Triangles& triangles) {
    rebuild::Bounds3 box;
    for (const glm::uvec3& t : triangles.triangles) {
        if (!usable(triangles, t)) continue;
        for (int corner = 0; corner < 3; ++corner) box.extend(triangles.positions[t[corner]]);
    }
    return box;
}

RayBatch pinhole(const glm::vec3& eye, const glm::vec3& target, float half_angle_tan, int side) {
    const glm::vec3 forward = glm::normalize(target - eye);
    const glm::vec3 up =
        std::fabs(forward.y) < 0.9f ? glm::vec3{0.0f, 1.0f, 0.0f} : glm::vec3{1.0f, 0.0f, 0.0f};
    const glm::vec3 right = glm::normalize(glm::cross(forward, up));
    const glm::vec3 above = glm::cross(right, forward);
    RayBatch rays;
    rays.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), eye, RayOrder::coherent);
    for_each_pixel(side, [&](std::size_t i, float u, float v) {
        set_ray(rays, i, forward + half_angle_tan * (u * right + v * above));
    });
    return rays;
}

RayBatch orthographic(const glm::vec3& middle, const glm::vec3& direction, float half, int side) {
    const glm::vec3 forward = glm::normalize(direction);
    const glm::vec3 up =
        std::fabs(forward.y) < 0.9f ? glm::vec3{0.0f, 1.0f, 0.0f} : glm::vec3{1.0f, 0.0f, 0.0f};
    const glm::vec3 right = glm::normalize(glm::cross(forward, up));
    const glm::vec3 above = glm::cross(right, forward);
    RayBatch rays;
    rays.resize_parallel(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), direction,
                         RayOrder::coherent);
    for_each_pixel(side, [&](std::size_t i, float u, float v) {
        set_parallel_ray(rays, i, middle + half * (u * right + v * above));
    });
    return rays;
}

RayBatch from_surfaces(const glm::vec3& direction, const Triangles& triangles, std::size_t count) {
    RayBatch rays;
    rays.resize_parallel(count, direction, RayOrder::arbitrary);
    Random random(28);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 point = point_of(triangles, random);
        const float aside = float(random.next() % 2) * 1e-6f;
        set_parallel_ray(rays, i, point + aside * glm::length(point) * random.on_sphere());
    }
    return rays;
}

RayBatch from_point(const glm::vec3& point, std::size_t count, std::uint64_t seed) {
    RayBatch rays;
    rays.resize(count, point, RayOrder::arbitrary);
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) set_ray(rays, i, random.on_sphere());
    return rays;
}

RayBatch towards_surfaces(const glm::vec3& point, const Triangles& triangles, std::size_t count) {
    RayBatch rays;
    rays.resize(count, point, RayOrder::arbitrary);
    Random random(17);
    for (std::size_t i = 0; i < count; ++i)
        set_ray(rays, i, point_of(triangles, random) - point, 0.0f, 0.999f);
    return rays;
}

std::vector<NamedRays> nasty_batches(const Triangles& triangles, std::size_t count) {
    const rebuild::Bounds3 box = finite_bounds(triangles);
    const glm::vec3 size = box.extent(), middle = box.min + 0.5f * size;
    const float length = glm::length(size);
    const glm::vec3 outside = middle + length * glm::vec3{0.3f, 0.5f, 1.1f};
    const glm::vec3 far_away = middle + length * glm::vec3{60.0f, 70.0f, -40.0f};
    const glm::vec3 inside = middle + 0.13f * size;
    Random random(18);
    const int side = static_cast<int>(std::sqrt(double(count)));

    std::vector<NamedRays> batches;
    batches.push_back({"camera outside", pinhole(outside, middle, 0.5f, side)});
    batches.push_back({"camera inside, wide", pinhole(inside, middle + size, 2.0f, side)});
    batches.push_back(
        {"camera along an axis", pinhole(middle - glm::vec3{0.0f, 0.0f, 2.0f * length}, middle, 0.3f, side)});
    batches.push_back({"camera far away", pinhole(far_away, middle, 0.005f, side)});
    batches.push_back({"all directions from inside", from_point(inside, count, 20)});
    batches.push_back(
        {"all directions from a corner of a triangle", from_point(point_of(triangles, random), count, 21)});
    batches.push_back({"all directions from a corner of the box", from_point(box.min, count, 22)});
    batches.push_back({"bounded, from a point", bounded_from_point(inside, box, count)});
    batches.push_back({"light to surfaces", towards_surfaces(outside, triangles, count)});
    batches.push_back({"scattered", random_rays(box, 0.5f, count, 23)});
    batches.push_back({"scattered from far", random_rays(box, 20.0f, count, 24)});
    batches.push_back({"along axes", axis_rays(box, count)});
    batches.push_back({"through corners and edges", through_features(triangles, box, count)});
    batches.push_back({"bounded, scattered", bounded(box, count)});
    add_parallel_batches(triangles, box, count, batches);
    for (NamedRays& mirror : mirror_batches(triangles, count)) batches.push_back(std::move(mirror));
    return batches;
}

}  // namespace gridreel::tests
