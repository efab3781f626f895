#pragma once
// Grids, compared bit by bit.

#include "rebuild/grid.h"

#include <cstdint>
#include <vector>

namespace gridreel::test {

/// Everything a grid holds, as bits: two grids are the same byte for byte if these are equal.
[[nodiscard]] std::vector<std::uint64_t> grid_contents(const rebuild::Grid& grid);

}  // namespace gridreel::test
