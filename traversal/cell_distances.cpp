#include "traversal/cell_distances.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gridreel::traversal {
namespace {

constexpr std::size_t cells_per_task = 1 << 14;  // fewer are not worth a thread

/// 0 where cells of a level hold anything, else `most`.
void find_occupied(const rebuild::GridLevel& level, int most, std::uint8_t* steps) {
    const auto empty = static_cast<std::uint8_t>(most);
    const std::size_t cells = level.cell_begin.size() - 1;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, cells_per_task), [&](const auto& range) {
        const std::uint32_t* const begin = level.cell_begin.data();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            steps[i] = begin[i] == begin[i + 1] ? empty : std::uint8_t{0};
        }
    });
}

/// The least of each cell and those of the same layer that touch it.
void least_around(const rebuild::UniformGrid& grid, int z, const std::uint8_t* steps, std::uint8_t* around) {
    const auto width = static_cast<std::size_t>(grid.resolution.x);
    const auto rows = static_cast<std::size_t>(grid.resolution.y);
    const std::size_t layer = static_cast<std::size_t>(z) * width * rows;
    for (std::size_t y = 0; y < rows; ++y) {
        const std::uint8_t* const here = steps + layer + y * width;
        const std::uint8_t* const before = y > 0 ? here - width : here;
        const std::uint8_t* const after = y + 1 < rows ? here + width : here;
        std::uint8_t* const least = around + layer + y * width;
        const auto column = [&](std::size_t x) { return std::min(here[x], std::min(before[x], after[x])); };
        if (width == 1) {
            least[0] = column(0);
            continue;
        }
        least[0] = std::min(column(0), column(1));
        for (std::size_t x = 1; x + 1 < width; ++x) {
            least[x] = std::min(column(x), std::min(column(x - 1), column(x + 1)));
        }
        least[width - 1] = std::min(column(width - 2), column(width - 1));
    }
}

/// No cell is farther than one step more than those that touch it.
void one_step_more(const rebuild::UniformGrid& grid, int z, const std::uint8_t* around, std::uint8_t* steps) {
    const std::size_t layer =
        static_cast<std::size_t>(grid.resolution.x) * static_cast<std::size_t>(grid.resolution.y);
    const std::uint8_t* const here = around + static_cast<std::size_t>(z) * layer;
    const std::uint8_t* const before = z > 0 ? here - layer : here;
    const std::uint8_t* const after = z + 1 < grid.resolution.z ? here + layer : here;
    std::uint8_t* const of = steps + static_cast<std::size_t>(z) * layer;
    for (std::size_t i = 0; i < layer; ++i) {
        const std::uint8_t least = std::min(here[i], std::min(before[i], after[i]));
        of[i] = std::min(of[i], static_cast<std::uint8_t>(least + 1));
    }
}

}  // namespace

void CellDistances::rebuild(const rebuild::Grid& grid, int most) {
    std::size_t cells = 0;
    for (std::size_t depth = 0; depth < grid.levels.size(); ++depth) {
        first_cell_[depth] = cells;
        const rebuild::GridLevel& level = grid.levels[depth];
        if (!level.grids.empty()) cells += level.cell_begin.size() - 1;
    }
    steps_.resize(cells);
    around_.resize(cells);
    for (std::size_t depth = 0; depth < grid.levels.size(); ++depth) {
        const rebuild::GridLevel& level = grid.levels[depth];
        if (level.grids.empty()) continue;
        find_occupied(level, most, steps_.data() + first_cell_[depth]);
        tbb::parallel_for(std::size_t{0}, level.grids.size(), [&](std::size_t i) {
            const rebuild::UniformGrid& one = level.grids[i];
            if (one.cell_count() == 0) return;
            std::uint8_t* const steps = steps_.data() + first_cell_[depth] + one.first_cell;
            std::uint8_t* const around = around_.data() + first_cell_[depth] + one.first_cell;
            const std::size_t layers_per_task =
                1 + cells_per_task / (std::size_t(one.resolution.x) * std::size_t(one.resolution.y));
            const auto for_each_layer = [&](const auto& work) {
                tbb::parallel_for(
                    tbb::blocked_range<int>(0, one.resolution.z, layers_per_task),
                    [&](const auto& layers) {
                        for (int z = layers.begin(); z < layers.end(); ++z) work(z);
                    },
                    tbb::simple_partitioner());
            };
            // A distance is right once as many steps have been looked around.
            const int widest = std::max({one.resolution.x, one.resolution.y, one.resolution.z});
            for (int step = 1; step < std::min(most, widest); ++step) {
                for_each_layer([&](int z) { least_around(one, z, steps, around); });
                for_each_layer([&](int z) { one_step_more(one, z, around, steps); });
            }
        });
    }
}

}  // namespace gridreel::traversal
