// Closed meshes leave no crack: no ray from inside escapes, whoever traces it and from wherever it comes.

#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gridreel::tests {
namespace {

using traversal::HitBatch;
using traversal::OcclusionBatch;
using traversal::RayBatch;
using traversal::RayOrder;
using traversal::Tracer;
using traversal::TracerKind;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t million = 1'000'000;
constexpr std::array lambdas{0.5f, 1.0f, 8.0f};

/// A closed mesh and a ball inside it.
struct Shell {
    Triangles mesh;
    glm::vec3 middle{0.0f};
    float radius = 1.0f;
};

/// Moves the vertices of a sphere in and out: hills and hollows, but still seen whole from the middle.
Triangles lumpy(Triangles ball) {
    for (glm::vec3& p : ball.positions)
        p *= 1.0f + 0.15f * std::sin(9.0f * p.x) * std::sin(7.0f * p.y) + 0.1f * std::sin(60.0f * p.z);
    ball.name = "lumpy sphere";
    return ball;
}

/// Finest at the poles, with 142 rings of some 80,000 triangles: far from the origin these round to points
/// and lines.
std::vector<Shell> shells(int rings = 142) {
    const Triangles ball = sphere(rings);
    const glm::vec3 far_away{1000.0f, -2000.0f, 3000.0f};
    std::vector<Shell> all{{ball, {}, 0.98f},
                           {lumpy(ball), {}, 0.7f},
                           {scaled(ball, 1e-3f, {}), {}, 0.98e-3f},
                           {scaled(ball, 1e6f, {}), {}, 0.98e6f},
                           {scaled(ball, 1.0f, far_away), far_away, 0.98f}};
    all[2].mesh.name = "sphere of a millimetre";
    all[3].mesh.name = "sphere of a thousand kilometres";
    all[4].mesh.name = "sphere far from the origin";
    return all;
}

std::unique_ptr<Tracer> tracer_of(TracerKind kind, float lambda, const Triangles& triangles) {
    auto tracer = traversal::make_tracer({.kind = kind, .resolution = {.lambda = lambda}});
    tracer->rebuild(triangles.view());
    return tracer;
}

/// How many rays find nothing in their way, by the one question and by the other.
std::size_t escaped_closest(Tracer& tracer, const RayBatch& rays) {
    HitBatch hits;
    tracer.closest_hits(rays, hits);
    return static_cast<std::size_t>(
        std::count(hits.triangle.begin(), hits.triangle.end(), traversal::no_triangle));
}
std::size_t escaped_any(Tracer& tracer, const RayBatch& rays) {
    OcclusionBatch blocked;
    tracer.any_hits(rays, blocked);
    return static_cast<std::size_t>(std::count(blocked.begin(), blocked.end(), std::uint8_t{0}));
}

void set_unbounded(RayBatch& rays, std::size_t ray, const glm::vec3& direction) {
    rays.set_direction(ray, direction);
    rays.t_min[ray] = 0.0f;
    rays.t_max[ray] = infinity;
}

glm::vec3 off_middle(const Shell& shell) {
    return shell.middle + shell.radius * glm::vec3{0.31f, -0.47f, 0.63f};
}

/// From anywhere in the ball in any direction; one in eight along an axis or a plane of axes.
RayBatch from_anywhere(const Shell& shell, std::size_t count, std::uint64_t seed) {
    RayBatch rays;
    rays.resize(count, std::nullopt, RayOrder::arbitrary);
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const float from_middle = shell.radius * std::cbrt(random.uniform(0.0f, 1.0f));
        rays.set_origin(i, shell.middle + from_middle * random.on_sphere());
        glm::vec3 direction = random.on_sphere();
        if (i % 8 == 0) direction[int(random.next() % 3)] = 0.0f;
        if (i % 16 == 0) direction[int(random.next() % 3)] = 0.0f;
        set_unbounded(rays, i, direction == glm::vec3{0.0f} ? glm::vec3{0.0f, 0.0f, -1.0f} : direction);
    }
    return rays;
}

/// Six pictures that together show everything around a point.
std::vector<RayBatch> all_around(const glm::vec3& eye, int side) {
    std::vector<RayBatch> faces;
    const float ahead = std::max(1.0f, glm::length(eye));
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {1.0f, -1.0f}) {
            glm::vec3 target = eye;
            target[axis] += sign * ahead;
            faces.push_back(pinhole(eye, target, 1.0f, side));
        }
    }
    return faces;
}

/// The cube [-1, 1]^3, each face `side` * `side` squares of two triangles.
Triangles tiled_cube(int side) {
    Triangles result{.name = "cube", .positions = {}, .triangles = {}};
    const float step = 2.0f / float(side);
    for (int axis = 0; axis < 3; ++axis) {
        for (const float face : {-1.0f, 1.0f}) {
            for (int j = 0; j < side; ++j) {
                for (int i = 0; i < side; ++i) {
                    const auto corner = [&](int u, int v) {
                        glm::vec3 p{0.0f};
                        p[axis] = face;
                        p[(axis + 1) % 3] = float(i + u) * step - 1.0f;
                        p[(axis + 2) % 3] = float(j + v) * step - 1.0f;
                        return p;
                    };
                    result.add(corner(0, 0), corner(1, 0), corner(1, 1));
                    result.add(corner(0, 0), corner(1, 1), corner(0, 1));
                }
            }
        }
    }
    return result;
}

/// Coordinates in multiples of 2^-20: below 2, their sums and differences are exact, two deep.
Triangles on_lattice(Triangles triangles) {
    for (glm::vec3& p : triangles.positions) p = glm::round(p * 0x1p20f) * 0x1p-20f;
    return triangles;
}

/// A ray through every corner and every edge's middle of every `every`-th triangle, from the origins in turn.
/// @param origins  a single one is common to all
RayBatch at_corners_and_edges(const Triangles& mesh, const std::vector<glm::vec3>& origins,
                              std::size_t every) {
    const bool common = origins.size() == 1;
    RayBatch rays;
    rays.resize(6 * ((mesh.triangles.size() + every - 1) / every),
                common ? std::optional(origins[0]) : std::nullopt, RayOrder::arbitrary);
    std::size_t ray = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += every) {
        for (int i = 0; i < 3; ++i) {
            const glm::vec3& a = mesh.positions[mesh.triangles[t][i]];
            const glm::vec3& b = mesh.positions[mesh.triangles[t][(i + 1) % 3]];
            // Not to the edge's middle but twice as far, since a sum is exact where its half may not be.
            for (const bool at_corner : {true, false}) {
                const glm::vec3& origin = origins[ray % origins.size()];
                if (!common) rays.set_origin(ray, origin);
                set_unbounded(rays, ray++, at_corner ? a - origin : (a - origin) + (b - origin));
            }
        }
    }
    return rays;
}

}  // namespace

TEST_CASE("no ray of two million from a point inside a closed mesh escapes, in packets",
          "[traversal][watertight]") {
    for (const Shell& shell : shells()) {
        for (const float lambda : lambdas) {
            INFO(shell.mesh.name << ", lambda " << lambda);
            const auto tracer = tracer_of(TracerKind::grid, lambda, shell.mesh);
            const glm::vec3 eye = off_middle(shell);
            const RayBatch everywhere = from_point(eye, million / 3 + 1, 72);
            CHECK(escaped_closest(*tracer, everywhere) == 0);
            CHECK(escaped_any(*tracer, everywhere) == 0);
            for (const RayBatch& picture : all_around(eye, 240)) {
                CHECK(escaped_closest(*tracer, picture) == 0);
                CHECK(escaped_any(*tracer, picture) == 0);
            }
        }
    }
}

namespace {

/// Shares the rays out over λ and the two questions.
void check_from_anywhere(const Shell& shell, std::size_t count) {
    std::uint64_t seed = 73;
    for (const float lambda : lambdas) {
        INFO(shell.mesh.name << ", lambda " << lambda);
        const auto tracer = tracer_of(TracerKind::grid, lambda, shell.mesh);
        const std::size_t share = count / (2 * lambdas.size()) + 1;
        CHECK(escaped_closest(*tracer, from_anywhere(shell, share, seed++)) == 0);
        CHECK(escaped_any(*tracer, from_anywhere(shell, share, seed++)) == 0);
    }
}

}  // namespace

TEST_CASE("no ray of a million from anywhere inside a closed sphere escapes", "[traversal][watertight]") {
    check_from_anywhere(shells().front(), million);
}

TEST_CASE("no ray of a million from inside lumpy, tiny, huge and far spheres escapes",
          "[traversal][watertight]") {
    const std::vector<Shell> all = shells();
    for (std::size_t i = 1; i < all.size(); ++i) check_from_anywhere(all[i], million / 4);
}

TEST_CASE("no ray of a million that goes alone from a point inside a closed mesh escapes",
          "[traversal][watertight]") {
    for (const Shell& shell : shells()) {
        for (const float lambda : lambdas) {
            INFO(shell.mesh.name << ", lambda " << lambda);
            const auto tracer = tracer_of(TracerKind::grid_single, lambda, shell.mesh);
            CHECK(escaped_closest(*tracer, from_point(off_middle(shell), million / 15 + 1, 74)) == 0);
        }
    }
}

namespace {

/// @param every  one triangle in how many is aimed at
void check_corners_and_edges(const Triangles& mesh, TracerKind kind, float lambda, std::size_t every) {
    // From these origins most slopes are whole multiples of 2^-7: edge functions are exactly zero.
    const std::vector<glm::vec3> origins{{0.0f, 0.0f, 0.0f}, {0.5f, 0.0f, 0.0f}, {-0.25f, 0.5f, 0.125f}};
    INFO(mesh.name << ", " << name_of(kind) << ", lambda " << lambda);
    const auto tracer = tracer_of(kind, lambda, mesh);
    for (const glm::vec3& origin : origins) {
        const RayBatch rays = at_corners_and_edges(mesh, {origin}, every);
        CHECK(escaped_closest(*tracer, rays) == 0);
        CHECK(escaped_any(*tracer, rays) == 0);
    }
    CHECK(escaped_closest(*tracer, at_corners_and_edges(mesh, origins, every)) == 0);
}

}  // namespace

TEST_CASE("rays exactly through corners and middles of edges of a closed mesh hit it",
          "[traversal][watertight]") {
    const Triangles cube = tiled_cube(64), ball = on_lattice(sphere(100));
    // As many cells along an axis of the cube as squares: their corners lie in the cells' walls.
    constexpr float lambda_of_squares = 5.34f;
    const auto squares =
        traversal::make_tracer({.kind = TracerKind::grid, .resolution = {.lambda = lambda_of_squares}});
    CHECK(squares->rebuild(cube.view()).resolution == glm::ivec3{64});

    for (const float lambda : {1.0f, lambda_of_squares}) {
        for (const Triangles* const mesh : {&cube, &ball}) {
            check_corners_and_edges(*mesh, TracerKind::grid, lambda, 3);
            check_corners_and_edges(*mesh, TracerKind::grid_single, lambda, 23);
        }
    }
    for (const Triangles& mesh : {tiled_cube(8), on_lattice(sphere(16))})
        check_corners_and_edges(mesh, TracerKind::naive, 1.0f, 1);
}

TEST_CASE("no ray from inside a closed mesh escapes the naive tracer", "[traversal][watertight]") {
    for (const Shell& shell : shells(24)) {
        INFO(shell.mesh.name);
        const auto tracer = tracer_of(TracerKind::naive, 1.0f, shell.mesh);
        CHECK(escaped_closest(*tracer, from_point(off_middle(shell), 6000, 75)) == 0);
        CHECK(escaped_any(*tracer, from_anywhere(shell, 3000, 76)) == 0);
    }
}

}  // namespace gridreel::tests
