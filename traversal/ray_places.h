#pragma once
// Where a ray runs within the cells of one grid.

#include "rebuild/grid.h"
#include "traversal/ray_walk.h"
#include "traversal/reference_boxes.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// Turns depths into `CellPlace`, not held within 0 and 255.
class RayPlaces {
public:
    RayPlaces(const rebuild::UniformGrid& grid, const RayLine& line) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double per_metre = double(CellPlace::per_cell) / grid.cell_size[axis];
            per_depth_[i] = line.slope[axis] * per_metre;
            at_zero_[i] = (line.origin[axis] - double(grid.bounds.min[axis])) * per_metre;
            last_[i] = grid.resolution[axis] - 1;
        }
    }

    /// Place in the cell that has `steps_left` as `WalkStart`.
    [[nodiscard]] float place(std::size_t axis, std::uint64_t steps_left, double depth) const {
        const auto left = static_cast<int>(steps_left >> (21 * axis) & 0xffff);
        const int cell = per_depth_[axis] > 0.0 ? last_[axis] - left : left;
        return static_cast<float>(at_zero_[axis] + depth * per_depth_[axis] -
                                  double(CellPlace::per_cell) * cell) +
               CellPlace::cell_begin;
    }

private:
    std::array<double, 3> per_depth_, at_zero_;
    std::array<int, 3> last_;
};

}  // namespace gridreel::traversal
