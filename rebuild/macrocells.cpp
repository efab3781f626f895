#include "rebuild/macrocells.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace gridreel::rebuild {

void Macrocells::rebuild(const Grid& grid) {
    if (grid.empty()) {
        resolution_ = glm::ivec3{0};
        occupied_.resize(0);
        return;
    }
    const glm::ivec3 cells = grid.top().resolution;
    resolution_ = (cells + (side - 1)) / side;
    occupied_.resize(static_cast<std::size_t>(resolution_.x) * static_cast<std::size_t>(resolution_.y) *
                     static_cast<std::size_t>(resolution_.z));
    const std::uint32_t* const begin = grid.levels[0].cell_begin.data() + grid.top().first_cell;
    tbb::parallel_for(0, resolution_.z, [&](int z) {
        for (int y = 0; y < resolution_.y; ++y) {
            for (int x = 0; x < resolution_.x; ++x) occupied_[index(x, y, z)] = 0;
        }
        for (int cell_z = z * side; cell_z < std::min((z + 1) * side, cells.z); ++cell_z) {
            for (int cell_y = 0; cell_y < cells.y; ++cell_y) {
                // Neighbours along x are one span of references.
                const std::size_t row =
                    (static_cast<std::size_t>(cell_z) * static_cast<std::size_t>(cells.y) +
                     static_cast<std::size_t>(cell_y)) *
                    static_cast<std::size_t>(cells.x);
                for (int x = 0; x < resolution_.x; ++x) {
                    const auto first = row + static_cast<std::size_t>(x * side);
                    const auto last = row + static_cast<std::size_t>(std::min((x + 1) * side, cells.x));
                    if (begin[first] != begin[last]) occupied_[index(x, cell_y / side, z)] = 1;
                }
            }
        }
    });
}

bool Macrocells::any_in(const glm::ivec3& first, const glm::ivec3& last) const {
    for (int z = first.z / side; z <= last.z / side; ++z) {
        for (int y = first.y / side; y <= last.y / side; ++y) {
            for (int x = first.x / side; x <= last.x / side; ++x) {
                if (occupied_[index(x, y, z)] != 0) return true;
            }
        }
    }
    return false;
}

}  // namespace gridreel::rebuild
