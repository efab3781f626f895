// Rays without common origin or direction that go as packets, and those that do not.

#include "mirror_rays.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace gridreel::tests {
namespace {

using traversal::HitBatch;
using traversal::make_tracer;
using traversal::OcclusionBatch;
using traversal::RayBatch;
using traversal::TraceReport;
using traversal::TracerKind;

TraceReport closest(TracerKind kind, const Triangles& triangles, const RayBatch& rays, HitBatch& hits) {
    const auto tracer = make_tracer({.kind = kind, .resolution = {}});
    tracer->rebuild(triangles.view());
    return tracer->closest_hits(rays, hits);
}

/// Of the rays of each batch, those that answer otherwise than the oracle's.
std::size_t disagreements(const Triangles& triangles, const RayBatch& rays) {
    HitBatch expected, actual;
    closest(TracerKind::naive, triangles, rays, expected);
    closest(TracerKind::grid, triangles, rays, actual);
    std::size_t count = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        count += expected.triangle[i] != actual.triangle[i] || expected.t[i] != actual.t[i] ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("rays of a flat mirror need none of what rays on their own need", "[traversal][loose]") {
    const Triangles triangles = sheet(40);
    const RayBatch rays = flat_mirror(triangles, 128);
    HitBatch hits;
    const TraceReport report = closest(TracerKind::grid, triangles, rays, hits);
    CHECK(std::count(hits.triangle.begin(), hits.triangle.end(), traversal::no_triangle) <
          static_cast<std::ptrdiff_t>(3 * rays.size() / 4));
    CHECK(report.extra_bytes == 0);
    CHECK(report.rays == rays.size());
    HitBatch alone;
    CHECK(report.cells < closest(TracerKind::grid_single, triangles, rays, alone).cells / 4);
}

TEST_CASE("rays that every neighbour of goes another way are not tried in packets", "[traversal][loose]") {
    const Triangles triangles = sheet(40);
    RayBatch rays = flat_mirror(triangles, 64);
    Random random(41);
    for (std::size_t i = 0; i < rays.size(); ++i) rays.set_direction(i, random.on_sphere());
    HitBatch hits;
    const TraceReport report = closest(TracerKind::grid, triangles, rays, hits);
    CHECK(report.extra_bytes > 0);
    CHECK(disagreements(triangles, rays) == 0);
}

TEST_CASE("a packet that becomes too much work leaves its rays to go on their own", "[traversal][loose]") {
    // Many long triangles that lie everywhere and are hit by nothing.
    const Triangles triangles = slivers(20'000);
    for (const NamedRays& batch : mirror_batches(triangles, 2000)) {
        INFO(batch.name);
        HitBatch hits;
        CHECK(closest(TracerKind::grid, triangles, batch.rays, hits).extra_bytes > 0);
        CHECK(disagreements(triangles, batch.rays) == 0);
    }
}

TEST_CASE("nothing can be hit by mirror rays in an empty scene", "[traversal][loose]") {
    const Triangles nothing{.name = "nothing", .positions = {}, .triangles = {}};
    const RayBatch rays = flat_mirror(sheet(4), 40);
    HitBatch hits;
    closest(TracerKind::grid, nothing, rays, hits);
    CHECK(std::count(hits.triangle.begin(), hits.triangle.end(), traversal::no_triangle) ==
          static_cast<std::ptrdiff_t>(rays.size()));
    const auto tracer = make_tracer({});
    tracer->rebuild(nothing.view());
    OcclusionBatch occluded;
    tracer->any_hits(rays, occluded);
    CHECK(std::count(occluded.begin(), occluded.end(), 0) == static_cast<std::ptrdiff_t>(rays.size()));
}

}  // namespace gridreel::tests
