#pragma once
// Which cells of a grid hold anything, a bit each.

#include "rebuild/buffer.h"
#include "rebuild/grid.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// A grid's cells, at every level of nesting, 1/32 the size of what says where their lists begin: a ray asks
/// most cells no more than whether they are empty, and waits less for caches.
class OccupiedCells {
public:
    /// Parallel.
    void rebuild(const rebuild::Grid& grid);

    /// @return a bit for each cell of the level, the lowest first
    [[nodiscard]] const std::uint64_t* level(std::size_t depth) const { return words_[depth].data(); }

    [[nodiscard]] static bool is_set(const std::uint64_t* words, std::size_t cell) {
        return (words[cell / 64] >> (cell % 64) & 1) != 0;
    }

private:
    std::array<rebuild::Buffer<std::uint64_t>, 1 + rebuild::deepest_nesting> words_;
};

}  // namespace gridreel::traversal
