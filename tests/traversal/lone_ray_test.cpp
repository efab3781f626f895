// The parts of the walks of rays on their own against their plain forms.

#include "rebuild/grid_builder.h"
#include "reference_intersection.h"
#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/cell_distances.h"
#include "traversal/reference_boxes.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <glm/common.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace gridreel::tests {
namespace {

/// Calls `visit(level, depth, grid, cell, index of the cell in the grid)` for every cell.
template <class Visit>
void for_each_cell(const rebuild::Grid& grid, const Visit& visit) {
    for (std::size_t depth = 0; depth < grid.levels.size(); ++depth) {
        const rebuild::GridLevel& level = grid.levels[depth];
        for (const rebuild::UniformGrid& one : level.grids) {
            std::size_t cell = one.first_cell;
            for (int z = 0; z < one.resolution.z; ++z) {
                for (int y = 0; y < one.resolution.y; ++y) {
                    for (int x = 0; x < one.resolution.x; ++x) {
                        visit(level, depth, one, cell++, glm::ivec3{x, y, z});
                    }
                }
            }
        }
    }
}

/// The number of steps, aslant ones included, from a cell to one that holds anything; `most` if there is none
/// nearer.
int steps_to_references(const rebuild::GridLevel& level, const rebuild::UniformGrid& grid,
                        const glm::ivec3& at, int most) {
    int least = most;
    const glm::ivec3 low = glm::max(at - most, glm::ivec3{0});
    const glm::ivec3 high = glm::min(at + most, grid.resolution - 1);
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                const std::size_t cell =
                    grid.first_cell +
                    static_cast<std::size_t>((z * grid.resolution.y + y) * grid.resolution.x + x);
                if (level.cell_begin[cell] == level.cell_begin[cell + 1]) continue;
                const glm::ivec3 steps = glm::abs(glm::ivec3{x, y, z} - at);
                least = std::min(least, std::max({steps.x, steps.y, steps.z}));
            }
        }
    }
    return least;
}

}  // namespace

TEST_CASE("a cell's distance is the number of steps to the nearest cell with references", "[traversal]") {
    static constexpr int farthest = traversal::CellDistances::farthest;
    const int most = GENERATE(1, 3, farthest);
    rebuild::GridBuilder builder({.lambda = 20.0f});
    for (const Triangles& triangles : {crowds_in_crowds(), sphere(24)}) {
        builder.rebuild(triangles.view());
        traversal::CellDistances distances;
        distances.rebuild(builder.grid(), most);
        std::size_t wrong = 0;
        std::array<std::size_t, 1 + farthest> at_distance{};
        for_each_cell(builder.grid(),
                      [&](const rebuild::GridLevel& level, std::size_t depth,
                          const rebuild::UniformGrid& grid, std::size_t cell, const glm::ivec3& at) {
                          const int expected = steps_to_references(level, grid, at, most);
                          ++at_distance[static_cast<std::size_t>(expected)];
                          wrong += distances.data()[distances.first_cell(depth) + cell] != expected ? 1 : 0;
                      });
        INFO(triangles.name);
        CHECK(wrong == 0);
        CHECK(at_distance[0] > 100);
        CHECK(at_distance[std::size_t(most)] > (triangles.name == "sphere" ? 100 : 0));
    }
}

TEST_CASE("boxes of references hold their triangles' part of the cell, and little more", "[traversal]") {
    rebuild::GridBuilder builder({.lambda = 0.05f});
    for (const Triangles& triangles : {crowds_in_crowds(), soup(3000, 0.2f)}) {
        builder.rebuild(triangles.view());
        traversal::ReferenceBoxes boxes;
        boxes.rebuild(builder.grid(), triangles.view());
        std::size_t checked = 0, too_small = 0, too_large = 0;
        for_each_cell(
            builder.grid(), [&](const rebuild::GridLevel& level, std::size_t depth,
                                const rebuild::UniformGrid& grid, std::size_t cell, const glm::ivec3& at) {
                const std::uint32_t begin = level.cell_begin[cell], end = level.cell_begin[cell + 1];
                if (begin == end || (level.references[begin] & rebuild::nested_mark) != 0) return;
                for (std::uint32_t i = begin; i < end; ++i) {
                    const glm::uvec3& corners = triangles.triangles[level.references[i]];
                    for (int axis = 0; axis < 3; ++axis) {
                        // In bytes, as places are.
                        const auto place = [&](std::uint32_t vertex) {
                            const double along =
                                double(triangles.positions[vertex][axis]) -
                                (double(grid.bounds.min[axis]) + at[axis] * grid.cell_size[axis]);
                            return 2.0 + 250.0 * along / grid.cell_size[axis];
                        };
                        const double a = place(corners.x), b = place(corners.y), c = place(corners.z);
                        const double least = std::clamp(std::min({a, b, c}), 0.0, 255.0);
                        const double most = std::clamp(std::max({a, b, c}), 0.0, 255.0);
                        const auto of_axis = static_cast<std::size_t>(axis);
                        const traversal::ReferenceBox& box = boxes.level(depth)[i];
                        const double low = box.low[of_axis];
                        const double high = 255.0 - box.below_255[of_axis];
                        const double slack = 250.0 * grid.slack[axis] / grid.cell_size[axis];
                        ++checked;
                        too_small += low > std::max(0.0, least - 1.0) || high < std::min(most, 254.0) ? 1 : 0;
                        too_large += low < least - 2.5 - slack || high > most + 1.5 + slack ? 1 : 0;
                    }
                }
            });
        INFO(triangles.name);
        CHECK(checked > 1000);
        CHECK(too_small == 0);
        CHECK(too_large == 0);
    }
}

TEST_CASE("a far ray meets the rim of a crowded cell's triangles, which stand a little beside their place",
          "[traversal]") {
    // Corners are rounded relative to the ray's origin: by more than the padding of the small cluster's box.
    Triangles triangles{.name = "cluster", .positions = {}, .triangles = {}};
    triangles.add({-50.0f, -50.0f, -50.0f}, {-49.0f, -50.0f, -50.0f}, {-50.0f, -49.0f, -50.0f});
    triangles.add({50.0f, 50.0f, 50.0f}, {49.0f, 50.0f, 50.0f}, {50.0f, 49.0f, 50.0f});
    Random random(81);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 corner = random.in_box(-0.01f, 0.01f);
        const auto near = [&] { return glm::clamp(corner + random.in_box(-0.004f, 0.004f), -0.01f, 0.01f); };
        triangles.add(near(), near(), near());
    }
    traversal::RayBatch rays;
    constexpr std::size_t count = 60'000;
    rays.resize(count, std::nullopt, traversal::RayOrder::arbitrary);
    const glm::vec3 eye{61.37f, 47.91f, 53.13f};
    for (std::size_t i = 0; i < count; ++i) {
        glm::vec3 target = random.in_box(-0.0101f, 0.0101f);
        target[static_cast<int>(i % 3)] = (i % 2 == 0 ? 0.01f : -0.01f) + random.uniform(-4e-6f, 4e-6f);
        rays.set_origin(i, eye);
        rays.set_direction(i, target - eye);
        rays.t_min[i] = 0.0f;
        rays.t_max[i] = 2.0f;
    }
    traversal::HitBatch expected, actual;
    const auto oracle = traversal::make_tracer({.kind = traversal::TracerKind::naive, .resolution = {}});
    oracle->rebuild(triangles.view());
    oracle->closest_hits(rays, expected);
    for (const auto kind : {traversal::TracerKind::grid, traversal::TracerKind::grid_single}) {
        INFO(traversal::name_of(kind));
        const auto tracer = traversal::make_tracer({.kind = kind, .resolution = {.lambda = 0.5f}});
        tracer->rebuild(triangles.view());
        tracer->closest_hits(rays, actual);
        std::size_t different = 0, hits = 0;
        for (std::size_t i = 0; i < count; ++i) {
            different += expected.triangle[i] != actual.triangle[i] || expected.t[i] != actual.t[i] ? 1 : 0;
            hits += expected.triangle[i] != traversal::no_triangle ? 1 : 0;
        }
        CHECK(hits > 1000);
        CHECK(different == 0);
    }
}

TEST_CASE("what incoherent rays cost does not depend on the number of threads", "[traversal]") {
    // Rays that are traced side by side share a mailbox, and so do tasks that one thread takes in a row.
    const Triangles triangles = soup(5'000, 0.4f);
    Random random(82);
    traversal::RayBatch rays;
    rays.resize(300'000, std::nullopt, traversal::RayOrder::arbitrary);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays.set_origin(i, random.in_box(-1.0f, 1.0f));
        rays.set_direction(i, random.on_sphere());
        rays.t_min[i] = 0.0f;
        rays.t_max[i] = 2.0f;
    }
    const auto with = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([&] {
            const auto tracer = traversal::make_tracer(
                {.kind = traversal::TracerKind::grid, .resolution = {.lambda = 0.25f}});
            tracer->rebuild(triangles.view());
            traversal::HitBatch hits;
            return tracer->closest_hits(rays, hits);
        });
    };
    const traversal::TraceReport alone = with(1), together = with(3);
    CHECK(alone.cells == together.cells);
    CHECK(alone.triangle_tests == together.triangle_tests);
    CHECK(alone.extra_bytes == together.extra_bytes);
    CHECK(alone.triangle_tests > rays.size());
}

}  // namespace gridreel::tests
