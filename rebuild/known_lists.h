#pragma once
// Lists of triangles that are taken over from the grid that was in the same place before.

#include "rebuild/grid.h"
#include "rebuild/still_triangles.h"

#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// Lists that need not be found anew: those that a level held last, of a grid with the same cells.
struct KnownLists {
    std::size_t first_cell = 0;            ///< of the level as it was
    const StillTriangles* only = nullptr;  ///< of what they list, only these; nullptr: all
};

/// Copies the lists of a grid's cells `begin` to `end - 1`, one after another.
/// @param level   as it was
/// @param to      room for all that those cells list
/// @param counts  one per cell of the grid: the length of each copied list is added to it
/// @return how many references were copied
std::uint32_t copy_known(const KnownLists& known, const GridLevel& level, std::size_t begin, std::size_t end,
                         std::uint32_t* to, std::uint32_t* counts);

/// Puts copied lists behind what was found for the same cells, and both in ascending order.
/// @param known         the lists of cells `begin` to `end - 1`, one after another
/// @param begins        one per cell of the grid, and one more: where its list begins in `references`
/// @param behind_found  one per cell of the grid: where what was found for it ends
void merge_known(const std::uint32_t* known, std::size_t begin, std::size_t end, const std::uint32_t* begins,
                 const std::uint32_t* behind_found, std::uint32_t* references);

}  // namespace gridreel::rebuild
