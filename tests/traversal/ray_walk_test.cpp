#include "traversal/ray_walk.h"
#include "rebuild/grid_builder.h"
#include "test_triangles.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <set>

namespace gridreel::tests {
namespace {

using traversal::ray_frame;
using traversal::RayWalk;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A grid of 4 x 3 x 2 unit cells with its corner at the origin.
rebuild::UniformGrid unit_cells() {
    rebuild::UniformGrid grid;
    grid.bounds = {.min = glm::vec3{0.0f}, .max = {4.0f, 3.0f, 2.0f}};
    grid.resolution = {4, 3, 2};
    grid.cell_size = glm::dvec3{1.0};
    return grid;
}

std::vector<std::size_t> cells_of(const rebuild::UniformGrid& grid, const glm::vec3& origin,
                                  const glm::vec3& direction, float t_max = infinity) {
    std::vector<std::size_t> cells;
    for (RayWalk walk(grid, origin, ray_frame(direction, 0.0f, t_max)); walk.inside(); walk.advance()) {
        cells.push_back(walk.cell());
        if (walk.exit_depth() >= double(t_max) * std::max({std::fabs(direction.x), std::fabs(direction.y),
                                                           std::fabs(direction.z)}))
            break;
    }
    return cells;
}

}  // namespace

TEST_CASE("a walk visits the cells of its ray in order", "[traversal]") {
    const rebuild::UniformGrid grid = unit_cells();
    CHECK(cells_of(grid, {-1.0f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}) == std::vector<std::size_t>{0, 1, 2, 3});
    CHECK(cells_of(grid, {9.0f, 2.5f, 1.5f}, {-2.0f, 0.0f, 0.0f}) ==
          std::vector<std::size_t>{23, 22, 21, 20});
    CHECK(cells_of(grid, {1.5f, 1.5f, 0.5f}, {0.0f, 1.0f, 0.0f}) == std::vector<std::size_t>{5, 9});
    // Up the slope 3/4 from the corner of the grid: x 1 at y 0.75, y 1 at x 4/3, x 2, y 2 at x 8/3, x 3.
    CHECK(cells_of(grid, {0.0f, 0.0f, 0.5f}, {4.0f, 3.0f, 0.0f}) ==
          std::vector<std::size_t>{0, 1, 5, 6, 10, 11});
    CHECK(cells_of(grid, {1.5f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}, 1.0f) == std::vector<std::size_t>{1, 2});
}

TEST_CASE("a walk that misses the grid visits nothing", "[traversal]") {
    const rebuild::UniformGrid grid = unit_cells();
    CHECK(cells_of(grid, {-1.0f, 0.5f, 0.5f}, {-1.0f, 0.0f, 0.0f}).empty());
    CHECK(cells_of(grid, {-1.0f, 3.5f, 0.5f}, {1.0f, 0.0f, 0.0f}).empty());
    CHECK(cells_of(grid, {-5.0f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}, 4.0f).empty());
    CHECK(cells_of({}, {0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}).empty());
}

TEST_CASE("a walk passes every cell that points of its ray lie in", "[traversal]") {
    const rebuild::UniformGrid grid = unit_cells();
    Random random(51);
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 origin = random.in_box(-3.0f, 6.0f), direction = random.on_sphere();
        const auto cells = cells_of(grid, origin, direction);
        const std::set<std::size_t> visited(cells.begin(), cells.end());
        CHECK(visited.size() == cells.size());
        for (int step = 0; step < 200; ++step) {
            const glm::dvec3 p = glm::dvec3{origin} + glm::dvec3{direction} * (step * 0.05 + 1e-3);
            const glm::dvec3 inside = glm::min(p, glm::dvec3{4.0, 3.0, 2.0} - p);
            const glm::dvec3 from_plane = glm::abs(p - glm::round(p));
            if (std::min({inside.x, inside.y, inside.z}) < 1e-6) continue;
            if (std::min({from_plane.x, from_plane.y, from_plane.z}) < 1e-6) continue;
            const auto cell = static_cast<std::size_t>(p.x) +
                              4 * (static_cast<std::size_t>(p.y) + 3 * static_cast<std::size_t>(p.z));
            REQUIRE(visited.count(cell) == 1);
        }
    }
}

}  // namespace gridreel::tests
