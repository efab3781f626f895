// The parts of the walk of single rays against their plain forms.

#include "rebuild/grid_builder.h"
#include "reference_intersection.h"
#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/occupied_cells.h"
#include "traversal/reference_boxes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

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

}  // namespace

TEST_CASE("the cells that count as occupied are those with references", "[traversal]") {
    rebuild::GridBuilder builder({.lambda = 4.0f});
    const Triangles triangles = crowds_in_crowds();
    builder.rebuild(triangles.view());
    traversal::OccupiedCells occupied;
    occupied.rebuild(builder.grid());
    std::size_t wrong = 0, empty = 0, full = 0;
    for_each_cell(builder.grid(), [&](const rebuild::GridLevel& level, std::size_t depth,
                                      const rebuild::UniformGrid&, std::size_t cell, const glm::ivec3&) {
        const bool expected = level.cell_begin[cell] < level.cell_begin[cell + 1];
        (expected ? full : empty) += 1;
        wrong += traversal::OccupiedCells::is_set(occupied.level(depth), cell) != expected ? 1 : 0;
    });
    CHECK(wrong == 0);
    CHECK(std::min(empty, full) > 100);
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
                if (end - begin < traversal::ReferenceBoxes::least_count ||
                    (level.references[begin] & rebuild::nested_mark) != 0) {
                    return;
                }
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
                        const double low = boxes.level(depth).low[of_axis][i];
                        const double high = boxes.level(depth).high[of_axis][i];
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

}  // namespace gridreel::tests
