#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace gridreel::tests {
namespace {

using traversal::HitBatch;
using traversal::make_tracer;
using traversal::OcclusionBatch;
using traversal::RayBatch;
using traversal::TracerKind;

/// Kinds that answer alike to the bit. Embree has its own idea of intervals and ties.
constexpr std::array exact_kinds{TracerKind::naive, TracerKind::grid, TracerKind::grid_single};

constexpr float infinity = std::numeric_limits<float>::infinity();

/// One ray from the origin's side of z = 1 along +z at (0.25, 0.25), with or without a common origin.
RayBatch one_ray(bool common, float t_min, float t_max) {
    RayBatch rays;
    const glm::vec3 origin{0.25f, 0.25f, 0.0f};
    rays.resize(1, common ? std::optional(origin) : std::nullopt, traversal::RayOrder::arbitrary);
    if (!common) rays.set_origin(0, origin);
    rays.set_direction(0, {0.0f, 0.0f, 2.0f});
    rays.t_min[0] = t_min;
    rays.t_max[0] = t_max;
    return rays;
}

Triangles triangle_at(float z) {
    Triangles triangles;
    triangles.add({0.0f, 0.0f, z}, {1.0f, 0.0f, z}, {0.0f, 1.0f, z});
    return triangles;
}

}  // namespace

TEST_CASE("t is in units of the direction's length and its interval is open", "[traversal]") {
    for (const TracerKind kind : exact_kinds) {
        for (const bool common : {true, false}) {
            INFO(name_of(kind) << (common ? ", common origin" : ", own origin"));
            const auto tracer = make_tracer({.kind = kind, .resolution = {}});
            const Triangles triangles = triangle_at(1.0f);
            tracer->rebuild(triangles.view());
            const auto hit_within = [&](float t_min, float t_max) {
                const RayBatch rays = one_ray(common, t_min, t_max);
                HitBatch hits;
                OcclusionBatch blocked;
                tracer->closest_hits(rays, hits);
                tracer->any_hits(rays, blocked);
                CHECK((hits.triangle[0] == 0) == (blocked[0] == 1));
                CHECK((hits.t[0] == 0.5f || hits.t[0] == infinity));
                return hits.triangle[0] == 0;
            };
            CHECK(hit_within(0.0f, infinity));
            CHECK(hit_within(0.49f, 0.51f));
            CHECK_FALSE(hit_within(0.5f, infinity));
            CHECK_FALSE(hit_within(0.0f, 0.5f));
            CHECK_FALSE(hit_within(0.6f, 0.4f));
        }
    }
}

TEST_CASE("of triangles at the same t the lowest index is hit", "[traversal]") {
    for (const TracerKind kind : exact_kinds) {
        INFO(name_of(kind));
        Triangles triangles = triangle_at(2.0f);
        for (int i = 0; i < 40; ++i) {
            const Triangles same = triangle_at(1.0f);
            triangles.add(same.positions[0], same.positions[1], same.positions[2]);
        }
        const auto tracer = make_tracer({.kind = kind, .resolution = {}});
        tracer->rebuild(triangles.view());
        for (const bool common : {true, false}) {
            HitBatch hits;
            tracer->closest_hits(one_ray(common, 0.0f, infinity), hits);
            CHECK(hits.triangle[0] == 1);
            CHECK(hits.t[0] == 0.5f);
        }
    }
}

TEST_CASE("without triangles nothing is hit, and the next frame may have some", "[traversal]") {
    for (const TracerKind kind : exact_kinds) {
        INFO(name_of(kind));
        const auto tracer = make_tracer({.kind = kind, .resolution = {}});
        const Triangles none, one = triangle_at(1.0f);
        Triangles bad;
        bad.add(glm::vec3{infinity}, glm::vec3{0.0f}, glm::vec3{1.0f});
        HitBatch hits;
        OcclusionBatch blocked;
        for (const bool common : {true, false}) {
            for (const Triangles* empty : std::initializer_list<const Triangles*>{&none, &bad}) {
                tracer->rebuild(empty->view());
                tracer->closest_hits(one_ray(common, 0.0f, infinity), hits);
                tracer->any_hits(one_ray(common, 0.0f, infinity), blocked);
                CHECK(hits.triangle[0] == traversal::no_triangle);
                CHECK(blocked[0] == 0);
            }
            tracer->rebuild(one.view());
            tracer->closest_hits(one_ray(common, 0.0f, infinity), hits);
            CHECK(hits.triangle[0] == 0);
        }
        RayBatch no_rays;
        no_rays.resize(0, glm::vec3{0.0f}, traversal::RayOrder::arbitrary);
        CHECK(tracer->closest_hits(no_rays, hits).rays == 0);
        CHECK(hits.t.size() == 0);
    }
}

TEST_CASE("a ray from nowhere hits nothing", "[traversal]") {
    const Triangles triangles = soup(100, 0.5f);
    for (const TracerKind kind : exact_kinds) {
        const auto tracer = make_tracer({.kind = kind, .resolution = {}});
        tracer->rebuild(triangles.view());
        for (const float bad : {infinity, std::numeric_limits<float>::quiet_NaN(), 1e30f}) {
            HitBatch hits;
            tracer->closest_hits(from_point({bad, 0.0f, 0.0f}, 500, 61), hits);
            INFO(name_of(kind) << " from " << bad);
            CHECK(std::count(hits.triangle.begin(), hits.triangle.end(), traversal::no_triangle) == 500);
        }
    }
}

TEST_CASE("packets test far fewer triangles than single rays, and both fewer than all", "[traversal]") {
    const Triangles triangles = sheet(100);
    const RayBatch rays = pinhole({0.2f, -2.0f, 1.5f}, {}, 0.4f, 256);
    HitBatch hits;
    const auto cells = [&](TracerKind kind) {
        const auto tracer = make_tracer({.kind = kind, .resolution = {}});
        tracer->rebuild(triangles.view());
        const auto report = tracer->closest_hits(rays, hits);
        CHECK(report.rays == rays.size());
        CHECK(report.triangle_tests < rays.size() * triangles.triangles.size() / 10);
        return report.cells;
    };
    CHECK(cells(TracerKind::grid) * 10 < cells(TracerKind::grid_single));
}

TEST_CASE("names of tracers go back and forth", "[traversal]") {
    for (const TracerKind kind : exact_kinds) CHECK(traversal::tracer_kind(name_of(kind)) == kind);
    CHECK_FALSE(traversal::tracer_kind("bvh"));
}

}  // namespace gridreel::tests
