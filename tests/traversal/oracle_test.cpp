// Every tracer against the naive one, on everything nasty.

#include "reference_intersection.h"
#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/simd_target.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gridreel::tests {
namespace {

using traversal::HitBatch;
using traversal::make_tracer;
using traversal::OcclusionBatch;
using traversal::RayBatch;
using traversal::Tracer;
using traversal::TraceReport;
using traversal::TracerKind;

std::vector<Triangles> nasty_triangles() {
    return {soup(1500, 0.1f),
            sheet(24),
            slivers(600),
            coplanar(300),
            boxes(6),
            degenerate(1000),
            teapot_in_stadium(),
            crowds_in_crowds(),
            scaled(soup(400, 0.2f), 1e6f, {3e6f, -2e6f, 5e6f}),
            scaled(soup(400, 0.2f), 1e-6f, {}),
            scaled(slivers(200), 1e-8f, {}),
            scaled(soup(200, 0.2f), 1e-11f, {}),
            scaled(sheet(16), 1.0f, {1000.0f, 2000.0f, 3000.0f})};
}

/// What disagrees first, or nothing.
std::string first_difference(const HitBatch& expected, const HitBatch& actual) {
    for (std::size_t i = 0; i < expected.t.size(); ++i) {
        if (expected.triangle[i] == actual.triangle[i] && expected.t[i] == actual.t[i]) continue;
        return "ray " + std::to_string(i) + ": triangle " + std::to_string(expected.triangle[i]) + " at t " +
               std::to_string(expected.t[i]) + " by the oracle, " + std::to_string(actual.triangle[i]) +
               " at " + std::to_string(actual.t[i]);
    }
    return {};
}

std::size_t differences(const OcclusionBatch& expected, const OcclusionBatch& actual) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) count += expected[i] != actual[i];
    return count;
}

/// Lifts the limit again, whatever happens.
struct SimdLimit {
    explicit SimdLimit(std::string_view name) { REQUIRE(traversal::limit_simd_target(name)); }
    SimdLimit(const SimdLimit&) = delete;
    SimdLimit& operator=(const SimdLimit&) = delete;
    ~SimdLimit() { traversal::limit_simd_target(""); }
};

/// @return how many rays were compared
std::size_t check_against_oracle(const Triangles& triangles, std::size_t rays_per_batch, float lambda) {
    const auto oracle = make_tracer({.kind = TracerKind::naive, .resolution = {}});
    oracle->rebuild(triangles.view());
    std::size_t compared = 0;
    for (const auto& [name, rays] : nasty_batches(triangles, rays_per_batch)) {
        HitBatch expected, actual;
        OcclusionBatch expected_blocked, actual_blocked;
        oracle->closest_hits(rays, expected);
        oracle->any_hits(rays, expected_blocked);
        for (const TracerKind kind : {TracerKind::grid, TracerKind::grid_single}) {
            INFO(triangles.name << ", " << name << ", " << name_of(kind) << ", lambda " << lambda);
            const auto tracer = make_tracer({.kind = kind, .resolution = {.lambda = lambda}});
            tracer->rebuild(triangles.view());
            tracer->closest_hits(rays, actual);
            CHECK(first_difference(expected, actual) == "");
            tracer->any_hits(rays, actual_blocked);
            CHECK(differences(expected_blocked, actual_blocked) == 0);
            compared += rays.size();
        }
    }
    return compared;
}

}  // namespace

TEST_CASE("every tracer gives the naive answer, bit for bit", "[traversal][oracle]") {
    std::size_t compared = 0;
    for (const Triangles& triangles : nasty_triangles())
        compared += check_against_oracle(triangles, 5000, 1.0f);
    CHECK(compared > 1'000'000);
}

TEST_CASE("rays that go on behind what they hit meet every triangle once, nearest first",
          "[traversal][oracle]") {
    // Each triangle three times over: itself, its back, and a copy that begins at another corner.
    const bool in_one_plane = GENERATE(false, true);
    Triangles triangles = in_one_plane ? coplanar(60) : soup(150, 0.4f);
    const std::vector<glm::uvec3> once = triangles.triangles;
    for (const glm::uvec3& t : once) triangles.triangles.emplace_back(t.x, t.z, t.y);
    for (const glm::uvec3& t : once) triangles.triangles.emplace_back(t.y, t.z, t.x);
    const std::size_t count = triangles.triangles.size();

    for (const TracerKind kind : {TracerKind::naive, TracerKind::grid, TracerKind::grid_single}) {
        for (NamedRays& batch : nasty_batches(triangles, 400)) {
            INFO(triangles.name << ", " << batch.name << ", " << name_of(kind));
            const auto tracer = make_tracer({.kind = kind, .resolution = {}});
            tracer->rebuild(triangles.view());

            // Without going on: one ray at a time against one triangle at a time.
            RayBatch& rays = batch.rays;
            std::vector<std::vector<std::pair<float, std::uint32_t>>> expected(rays.size());
            const auto alone = make_tracer({.kind = TracerKind::naive, .resolution = {}});
            HitBatch hits;
            for (std::uint32_t i = 0; i < count; ++i) {
                alone->rebuild({triangles.positions, std::span(triangles.triangles).subspan(i, 1)});
                alone->closest_hits(rays, hits);
                for (std::size_t ray = 0; ray < rays.size(); ++ray) {
                    if (hits.triangle[ray] != traversal::no_triangle)
                        expected[ray].emplace_back(hits.t[ray], i);
                }
            }

            std::vector<std::vector<std::pair<float, std::uint32_t>>> met(rays.size());
            tracer->closest_hits(rays, hits);
            for (std::size_t round = 0; round <= count; ++round) {
                rays.after_triangle.resize(rays.size());
                std::size_t still_going = 0;
                for (std::size_t ray = 0; ray < rays.size(); ++ray) {
                    if (hits.triangle[ray] == traversal::no_triangle) {
                        rays.t_max[ray] = rays.t_min[ray];
                        rays.after_triangle[ray] = 0;
                        continue;
                    }
                    ++still_going;
                    met[ray].emplace_back(hits.t[ray], hits.triangle[ray]);
                    rays.after_triangle[ray] = hits.triangle[ray];
                }
                if (still_going == 0) break;
                tracer->closest_hits(rays, hits);
            }
            std::size_t wrong = 0;
            for (std::size_t ray = 0; ray < rays.size(); ++ray) {
                CHECK(std::is_sorted(met[ray].begin(), met[ray].end(),
                                     [](const auto& a, const auto& b) { return a.first < b.first; }));
                std::sort(met[ray].begin(), met[ray].end());
                std::sort(expected[ray].begin(), expected[ray].end());
                wrong += met[ray] != expected[ray];
            }
            CHECK(wrong == 0);
        }
    }
}

TEST_CASE("crowded cells really are nested in these tests", "[traversal]") {
    const Triangles triangles = crowds_in_crowds();
    const auto report = make_tracer({})->rebuild(triangles.view());
    CHECK(report.nested_grids >= 3);
}

TEST_CASE("rays from thousands of diagonals away find the triangles in their small cells",
          "[traversal][oracle]") {
    for (const Triangles& triangles : {boxes(8), crowds_in_crowds()}) {
        const auto box = finite_bounds(triangles);
        const glm::vec3 middle = 0.5f * (box.min + box.max);
        const float diagonal = glm::length(box.extent());
        const RayBatch rays =
            pinhole(middle + diagonal * glm::vec3{900.0f, 1500.0f, 2000.0f}, middle, 0.0002f, 128);
        HitBatch expected, actual;
        const auto oracle = make_tracer({.kind = TracerKind::naive, .resolution = {}});
        oracle->rebuild(triangles.view());
        oracle->closest_hits(rays, expected);
        CHECK(std::count(expected.triangle.begin(), expected.triangle.end(), traversal::no_triangle) <
              static_cast<std::ptrdiff_t>(rays.size() - 100));
        for (const TracerKind kind : {TracerKind::grid, TracerKind::grid_single}) {
            const auto tracer = make_tracer({.kind = kind, .resolution = {.lambda = 500.0f}});
            tracer->rebuild(triangles.view());
            tracer->closest_hits(rays, actual);
            INFO(triangles.name << ", " << name_of(kind));
            CHECK(first_difference(expected, actual) == "");
        }
    }
}

TEST_CASE("the answer does not depend on lambda", "[traversal][oracle]") {
    for (const float lambda : {0.01f, 0.4f, 20.0f, 500.0f}) {
        check_against_oracle(soup(700, 0.15f), 600, lambda);
        check_against_oracle(boxes(4), 600, lambda);
        check_against_oracle(crowds_in_crowds(), 600, lambda);
    }
}

TEST_CASE("every SIMD target gives its own naive answer", "[traversal][oracle][simd]") {
    for (const std::string_view target : traversal::simd_targets()) {
        const SimdLimit limit(target);
        INFO(target);
        // Enough rays that boxes of references are worth it.
        check_against_oracle(soup(500, 0.2f), 4000, 1.0f);
        check_against_oracle(coplanar(150), 4000, 1.0f);
        check_against_oracle(degenerate(300), 4000, 1.0f);
    }
}

TEST_CASE("targets with fused multiply-add agree bit for bit, others within rounding", "[traversal][simd]") {
    const Triangles triangles = soup(2000, 0.1f);
    const RayBatch rays = pinhole({0.3f, 0.4f, 3.0f}, {}, 0.5f, 128);
    HitBatch best, other;
    const auto tracer = make_tracer({});
    tracer->rebuild(triangles.view());
    tracer->closest_hits(rays, best);
    const bool best_fuses = traversal::simd_target().substr(0, 3) == "AVX";
    for (const std::string_view target : traversal::simd_targets()) {
        const SimdLimit limit(target);
        INFO(target);
        tracer->closest_hits(rays, other);
        if ((target.substr(0, 3) == "AVX") == best_fuses) {
            CHECK(first_difference(best, other) == "");
            continue;
        }
        std::size_t disagreements = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            disagreements += best.triangle[i] != other.triangle[i];
            if (best.triangle[i] == other.triangle[i] && best.triangle[i] != traversal::no_triangle) {
                // Rounding is magnified where the triangle is seen at a low angle.
                const auto exact = intersect(triangles, best.triangle[i], glm::dvec3{rays.origin_of(i)},
                                             glm::dvec3{rays.direction_of(i)});
                REQUIRE(exact);
                CHECK(std::fabs(double(other.t[i]) / double(best.t[i]) - 1.0) < 1e-6 / exact->facing);
            }
        }
        CHECK(disagreements <= rays.size() / 1000);
    }
}

TEST_CASE("hits and reports do not depend on the number of threads", "[traversal]") {
    const Triangles triangles = soup(3000, 0.1f);
    for (const NamedRays& batch : nasty_batches(triangles, 4000)) {
        INFO(batch.name);
        HitBatch one, many;
        for (const TracerKind kind : {TracerKind::grid, TracerKind::grid_single}) {
            const auto trace = [&](int threads, HitBatch& hits) {
                return tbb::task_arena(threads).execute([&] {
                    const auto tracer = make_tracer({.kind = kind, .resolution = {}});
                    tracer->rebuild(triangles.view());
                    TraceReport report = tracer->closest_hits(batch.rays, hits);
                    OcclusionBatch occluded;
                    report += tracer->any_hits(batch.rays, occluded);
                    return report;
                });
            };
            const TraceReport by_one = trace(1, one), by_many = trace(8, many);
            CHECK(first_difference(one, many) == "");
            CHECK(by_one.rays == by_many.rays);
            CHECK(by_one.cells == by_many.cells);
            CHECK(by_one.triangle_tests == by_many.triangle_tests);
            CHECK(by_one.extra_bytes == by_many.extra_bytes);
            const bool on_their_own = kind == TracerKind::grid_single || batch.name == "scattered";
            if (on_their_own) CHECK(by_one.extra_bytes > 0);
        }
    }
}

}  // namespace gridreel::tests
