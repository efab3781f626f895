// Crowded cells that a tuft of slivers only passes by: grids of their own, with nothing in them.

#include "rebuild/grid_builder.h"
#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::tests {
namespace {

/// Scattered triangles in a cube of 13 x 13 x 13 cells (λ = 1), and 200 slivers along one line, up to two
/// and a half cells long. They are listed in cells that they come near; the nested grids of those that they
/// do cross need too many references and are dropped.
Triangles tuft(std::uint64_t seed) {
    Triangles triangles = soup(2000, 0.02f);
    Random random(seed);
    const glm::vec3 root = random.in_box(-0.8f, 0.8f);
    const glm::vec3 way = random.on_sphere() * random.uniform(0.12f, 0.38f);
    for (int i = 0; i < 200; ++i) {
        const auto beside = [&] { return random.in_box(-1e-5f, 1e-5f); };
        triangles.add(root + beside(), root + beside(), root + way + beside());
    }
    return triangles;
}

}  // namespace

TEST_CASE("a level of nested grids may hold nothing at all", "[traversal]") {
    int levels_of_nothing = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Triangles triangles = tuft(seed);
        rebuild::GridBuilder builder({.lambda = 1.0f});
        builder.rebuild(triangles.view());
        const rebuild::GridLevel& nested = builder.grid().levels[1];
        if (nested.grids.empty() || !nested.references.empty()) continue;
        ++levels_of_nothing;
        INFO("seed " << seed);
        CHECK(nested.references.data() != nullptr);  // packets read whole registers from any list's begin
        const traversal::RayBatch rays = pinhole({0.3f, -0.2f, 3.0f}, {0.0f, 0.0f, 0.0f}, 0.5f, 64);
        traversal::HitBatch expected, actual;
        const auto trace = [&](traversal::TracerKind kind, traversal::HitBatch& hits) {
            const auto tracer = traversal::make_tracer({.kind = kind, .resolution = {.lambda = 1.0f}});
            tracer->rebuild(triangles.view());
            tracer->closest_hits(rays, hits);
        };
        trace(traversal::TracerKind::naive, expected);
        trace(traversal::TracerKind::grid, actual);
        std::size_t different = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            different += expected.triangle[i] != actual.triangle[i] || expected.t[i] != actual.t[i] ? 1 : 0;
        }
        CHECK(different == 0);
    }
    CHECK(levels_of_nothing > 0);
}

}  // namespace gridreel::tests
