// Rays whose neighbours in the batch may or may not be neighbours in space: asked as they come where that is
// cheap, sorted where it is not.

#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/ray_sort.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace gridreel::tests {
namespace {

using traversal::OcclusionBatch;
using traversal::RayBatch;
using traversal::RayOrder;
using traversal::TraceReport;
using traversal::TracerKind;

/// A picture of 512 x 512 rays: 512 packets, 32 times as many as are judged together. Some rays end early.
RayBatch picture() {
    RayBatch rays = pinhole({0.3f, -0.2f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.6f, 512);
    for (std::size_t i = 0; i < rays.size(); i += 5) rays.t_max[i] = 0.01f;
    return rays;
}

/// A sun's shadow rays from as many points of a picture, above and between the triangles.
RayBatch sunlit_picture() {
    RayBatch rays = orthographic({0.1f, 0.3f, 0.2f}, {-0.2f, -0.5f, -1.0f}, 1.1f, 512);
    for (std::size_t i = 0; i < rays.size(); i += 5) rays.t_max[i] = 0.01f;
    return rays;
}

void swap_rays(RayBatch& rays, std::size_t a, std::size_t b) {
    for (auto& axis : rays.common_direction ? rays.origin : rays.direction) std::swap(axis[a], axis[b]);
    std::swap(rays.t_min[a], rays.t_min[b]);
    std::swap(rays.t_max[a], rays.t_max[b]);
}

/// Puts rays [begin, end) in no order.
void shuffle(RayBatch& rays, std::size_t begin, std::size_t end) {
    Random random(71);
    for (std::size_t i = end - begin; i > 1; --i) swap_rays(rays, begin + i - 1, begin + random.next() % i);
}

TraceReport blocked(TracerKind kind, const Triangles& triangles, RayBatch& rays, RayOrder order,
                    OcclusionBatch& result) {
    const auto tracer = traversal::make_tracer({.kind = kind, .resolution = {}});
    tracer->rebuild(triangles.view());
    rays.order = order;
    return tracer->any_hits(rays, result);
}

bool same(const OcclusionBatch& a, const OcclusionBatch& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

TEST_CASE("rays are blocked alike whether they are asked as they come or sorted", "[traversal]") {
    const bool parallel = GENERATE(false, true);
    for (const Triangles& triangles : {soup(20'000, 0.03f), sheet(80), teapot_in_stadium()}) {
        RayBatch rays = parallel ? sunlit_picture() : picture();
        // All coherent; a quarter not, at a place that cuts packets; single strays, and rays that hit
        // nothing.
        const auto check = [&](const char* what) {
            INFO(triangles.name << ", " << what << (parallel ? ", parallel" : ""));
            OcclusionBatch expected, actual;
            blocked(TracerKind::grid_single, triangles, rays, RayOrder::arbitrary, expected);
            const TraceReport report =
                blocked(TracerKind::grid, triangles, rays, RayOrder::arbitrary, actual);
            CHECK(same(expected, actual));
            CHECK(report.rays == rays.size());
            CHECK(std::count(expected.begin(), expected.end(), 1) > 0);
            CHECK(std::count(expected.begin(), expected.end(), 0) > 0);
        };
        check("coherent");
        shuffle(rays, rays.size() / 2 + 77, rays.size() * 3 / 4 + 1);
        check("a quarter shuffled");
        for (std::size_t i = 100; i + 50'000 < rays.size(); i += 3000) swap_rays(rays, i, i + 50'000);
        for (std::size_t i = 5; i < rays.size(); i += 11) rays.t_max[i] = 0.0f;
        check("strays and dead rays");
    }
}

TEST_CASE("coherent rays of which nothing is known are not sorted", "[traversal]") {
    // Few large triangles: every packet is cheap, and cells are looked into as if the order were known.
    const Triangles triangles = sheet(6);
    RayBatch rays = GENERATE(false, true) ? sunlit_picture() : picture();
    OcclusionBatch result;
    const TraceReport known = blocked(TracerKind::grid, triangles, rays, RayOrder::coherent, result);
    const TraceReport unknown = blocked(TracerKind::grid, triangles, rays, RayOrder::arbitrary, result);
    CHECK(unknown.cells == known.cells);
    CHECK(unknown.triangle_tests == known.triangle_tests);
}

TEST_CASE("incoherent rays cost little more than if they were sorted at once", "[traversal]") {
    const Triangles triangles = soup(20'000, 0.03f);
    RayBatch rays = from_point({0.0f, 0.0f, 0.0f}, 200'000, 72);
    OcclusionBatch result;
    const TraceReport report = blocked(TracerKind::grid, triangles, rays, RayOrder::arbitrary, result);
    traversal::RaySort sort;
    const auto& order = sort.sort(rays).order;
    RayBatch sorted = from_point({0.0f, 0.0f, 0.0f}, 200'000, 72);
    for (std::size_t i = 0; i < order.size(); ++i) sorted.set_direction(i, rays.direction_of(order[i]));
    const TraceReport best = blocked(TracerKind::grid, triangles, sorted, RayOrder::coherent, result);
    CHECK(report.cells < best.cells * 5 / 4);
}

TEST_CASE("sorted parallel rays cost far less than in no order", "[traversal]") {
    const Triangles triangles = soup(20'000, 0.03f);
    RayBatch rays = orthographic({0.1f, 0.3f, 0.2f}, {-0.2f, -0.5f, -1.0f}, 1.1f, 192);
    shuffle(rays, 0, rays.size());
    OcclusionBatch result;
    const TraceReport sorted = blocked(TracerKind::grid, triangles, rays, RayOrder::arbitrary, result);
    const TraceReport as_they_come = blocked(TracerKind::grid, triangles, rays, RayOrder::coherent, result);
    CHECK(10 * sorted.triangle_tests < as_they_come.triangle_tests);
}

TEST_CASE("what work is given up as too much does not depend on the number of threads", "[traversal]") {
    const Triangles triangles = teapot_in_stadium();
    RayBatch rays = picture();
    shuffle(rays, 10'000, 100'000);
    OcclusionBatch result;
    const auto with = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute(
            [&] { return blocked(TracerKind::grid, triangles, rays, RayOrder::arbitrary, result); });
    };
    const TraceReport alone = with(1), together = with(3);
    CHECK(alone.cells == together.cells);
    CHECK(alone.triangle_tests == together.triangle_tests);
}

TEST_CASE("only undecided rays are sorted", "[traversal]") {
    const RayBatch rays = from_point({0.1f, 0.2f, 0.3f}, 50'001, 73);
    OcclusionBatch marks;
    marks.resize(rays.size());
    Random random(74);
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        marks[i] = static_cast<std::uint8_t>(i < 1000 ? 0 : random.next() % 3);
        if (marks[i] == traversal::undecided) expected.push_back(static_cast<std::uint32_t>(i));
    }
    traversal::RaySort sort;
    const auto& sorted = sort.sort_undecided(rays, marks);
    std::vector<std::uint32_t> order(sorted.order.begin(), sorted.order.end());
    std::sort(order.begin(), order.end());
    CHECK(order == expected);

    std::fill(marks.begin(), marks.end(), std::uint8_t{1});
    CHECK(sort.sort_undecided(rays, marks).order.empty());
}

}  // namespace gridreel::tests
