#include "tests/rebuild/grid_contents.h"

#include <bit>

namespace gridreel::test {

std::vector<std::uint64_t> grid_contents(const rebuild::Grid& grid) {
    std::vector<std::uint64_t> all;
    for (const rebuild::GridLevel& level : grid.levels) {
        all.push_back(level.grids.size());
        all.insert(all.end(), level.cell_begin.begin(), level.cell_begin.end());
        all.push_back(level.references.size());
        all.insert(all.end(), level.references.begin(), level.references.end());
        for (const rebuild::UniformGrid& g : level.grids) {
            for (int axis = 0; axis < 3; ++axis) {
                all.push_back(std::bit_cast<std::uint32_t>(g.bounds.min[axis]));
                all.push_back(std::bit_cast<std::uint32_t>(g.bounds.max[axis]));
                all.push_back(static_cast<std::uint64_t>(g.resolution[axis]));
                all.push_back(std::bit_cast<std::uint64_t>(g.cell_size[axis]));
                all.push_back(std::bit_cast<std::uint64_t>(g.slack[axis]));
            }
            all.push_back(std::bit_cast<std::uint64_t>(g.least_slack));
            all.push_back(g.first_cell);
        }
    }
    return all;
}

}  // namespace gridreel::test
