// The grid and Embree on a million rays a scene: they differ only where a ray passes an edge within rounding.

#include "skip_without_embree.h"
#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace gridreel::tests {
namespace {

using traversal::HitBatch;
using traversal::RayBatch;
using traversal::Tracer;
using traversal::TracerKind;

/// 64 bits of mantissa: to its precision, differences of floats are exact, and so is nearly all the rest.
using Real = long double;
using Vec = glm::vec<3, Real>;

constexpr std::size_t million = 1'000'000;

/// How a ray passes a triangle that it need not hit.
struct Passing {
    Real t = 0.0;
    Real clearance = 0.0;  ///< metres to the nearest edge's line: positive inside, negative outside
    Real reach = 0.0;      ///< metres from the ray's origin to the farthest corner
};

/// Nothing when the triangle is seen exactly edge-on.
std::optional<Passing> passing(const Triangles& triangles, std::uint32_t triangle, const Vec& origin,
                               const Vec& direction) {
    std::array<Vec, 3> corner;
    for (int i = 0; i < 3; ++i)
        corner[std::size_t(i)] = Vec{triangles.positions[triangles.triangles[triangle][i]]} - origin;
    const Vec normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
    const Real facing = glm::dot(normal, direction);
    if (facing == 0.0L) return std::nullopt;

    Passing found{.t = glm::dot(normal, corner[0]) / facing,
                  .clearance = std::numeric_limits<Real>::infinity()};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec &a = corner[i], &b = corner[(i + 1) % 3];
        const Vec between = glm::cross(b - a, direction);
        const Real distance = glm::dot(a, between) / glm::length(between);
        found.clearance = std::min(found.clearance, facing > 0.0L ? distance : -distance);
        found.reach = std::max(found.reach, glm::length(a));
    }
    return found;
}

/// What becomes of a ray without rounding, and whether rounding excuses another answer.
struct Truth {
    bool hit = false;
    bool in_doubt = false;
};

/// In doubt is a ray that clearly hits nothing, but passes some edge, or an end of its interval, by less than
/// a float's ulp of the distance. (Seen edge-on, a triangle's edges are one: that is the same doubt.)
Truth truth_of(const Triangles& triangles, const RayBatch& rays, std::size_t ray) {
    constexpr Real ulp = std::numeric_limits<float>::epsilon();
    const Vec origin{rays.origin_of(ray)}, direction{rays.direction_of(ray)};
    const Real t_min = rays.t_min[ray], t_max = rays.t_max[ray];
    Truth truth;
    bool clearly_hit = false;
    for (std::uint32_t i = 0; i < triangles.triangles.size(); ++i) {
        const auto at = passing(triangles, i, origin, direction);
        const Real tolerance = at ? ulp * at->reach : 0.0L;
        const Real t_tolerance = at ? 8.0L * ulp * at->t : 0.0L;
        if (!at || at->clearance < -tolerance || at->t <= t_min - t_tolerance || at->t >= t_max + t_tolerance)
            continue;
        truth.hit = truth.hit || (at->clearance >= 0.0L && at->t > t_min && at->t < t_max);
        const bool clear =
            at->clearance > tolerance && at->t > t_min + t_tolerance && at->t < t_max - t_tolerance;
        clearly_hit = clearly_hit || clear;
        truth.in_doubt = true;
    }
    truth.in_doubt = truth.in_doubt && !clearly_hit;
    return truth;
}

struct Disagreement {
    std::size_t rays = 0;         ///< that only one of the two sees hit
    std::size_t ours_wrong = 0;   ///< of those, where Embree is right
    std::size_t unexplained = 0;  ///< of those, beyond doubt
};

Disagreement disagreement(const Triangles& triangles, const RayBatch& rays) {
    const auto answer = [&](const traversal::TracerOptions& options) {
        const std::unique_ptr<Tracer> tracer = traversal::make_tracer(options);
        tracer->rebuild(triangles.view());
        HitBatch hits;
        tracer->closest_hits(rays, hits);
        return hits;
    };
    const HitBatch ours = answer({.kind = TracerKind::grid, .resolution = {}});
    const HitBatch theirs = answer({.kind = TracerKind::embree, .resolution = {}});

    std::size_t hits = 0;
    Disagreement found;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool hit = ours.triangle[i] != traversal::no_triangle;
        hits += hit;
        if (hit == (theirs.triangle[i] != traversal::no_triangle)) continue;
        const Truth truth = truth_of(triangles, rays, i);
        ++found.rays;
        found.ours_wrong += truth.hit != hit;
        found.unexplained += !truth.in_doubt;
    }
    CHECK(rays.size() >= million);
    CHECK(hits > 20'000);
    return found;
}

/// Of a million rays at most one is wrong, and Embree is not much worse.
void check_agreement(const Triangles& triangles, const RayBatch& rays) {
    const Disagreement found = disagreement(triangles, rays);
    INFO(triangles.name);
    CHECK(found.ours_wrong <= 1);
    CHECK(found.rays <= 4);
    CHECK(found.unexplained == 0);
}

RayBatch picture(const glm::vec3& target) {
    return pinhole(target + glm::vec3{0.4f, 0.9f, 2.5f}, target, 0.5f, 1024);
}

/// A fine sheet in the middle of a bowl four hundred times as large.
Triangles stadium() {
    Triangles result = scaled(sheet(190), 0.5f, {30.0f, 20.0f, 10.0f});
    const Triangles bowl = scaled(sphere(30), 200.0f, {});
    for (const glm::uvec3& t : bowl.triangles)
        result.add(bowl.positions[t.x], bowl.positions[t.y], bowl.positions[t.z]);
    result.name = "stadium";
    return result;
}

/// As in the gallery: half a metre long, 120 times longer than wide.
Triangles needles(std::size_t count) {
    Triangles result{.name = "needles", .positions = {}, .triangles = {}};
    Random random(81);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 middle = random.in_box(-0.7f, 0.7f), along = random.on_sphere();
        const glm::vec3 side = glm::normalize(glm::cross(along, random.on_sphere()));
        const glm::vec3 half_length = 0.25f * along, half_width = 0.25f / 120.0f * side;
        result.add(middle - half_length - half_width, middle - half_length + half_width,
                   middle + half_length);
    }
    return result;
}

}  // namespace

TEST_CASE("the grid and Embree agree on a million camera rays onto a sheet", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    check_agreement(sheet(200), picture({}));
}

TEST_CASE("the grid and Embree agree on a million camera rays into a stadium", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    check_agreement(stadium(), picture({30.0f, 20.0f, 10.0f}));
}

TEST_CASE("the grid and Embree agree on a million camera rays into a soup", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    check_agreement(soup(80'000, 0.02f), picture({}));
}

TEST_CASE("the grid and Embree agree on a million rays with ends from anywhere in a soup",
          "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    RayBatch rays;
    rays.resize(million, std::nullopt, traversal::RayOrder::arbitrary);
    Random random(82);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays.set_origin(i, random.in_box(-1.2f, 1.2f));
        rays.set_direction(i, random.on_sphere() * random.uniform(0.1f, 3.0f));
        rays.t_min[i] = random.uniform(0.0f, 0.2f);
        rays.t_max[i] = random.uniform(0.0f, 2.0f);
    }
    check_agreement(soup(20'000, 0.05f), rays);
}

TEST_CASE("among needles the grid and Embree differ only where a ray passes an edge within rounding",
          "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    // With nothing but outlines to pass, it is a few in a million.
    const Disagreement found = disagreement(needles(50'000), picture({}));
    CHECK(found.rays <= 10);
    CHECK(found.unexplained == 0);
}

}  // namespace gridreel::tests
