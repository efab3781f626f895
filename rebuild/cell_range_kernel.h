#pragma once
// The inner loops of a rebuild, chosen for the machine's SIMD instructions at run time.

#include "rebuild/bounds.h"
#include "rebuild/cell_mapping.h"
#include "rebuild/triangle_view.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// A list of triangles: indices somebody else owns, or all from 0 on.
struct TriangleList {
    const std::uint32_t* indices = nullptr;  ///< ascending; nullptr: the i-th triangle is i
    std::size_t count = 0;

    [[nodiscard]] std::uint32_t operator[](std::size_t i) const {
        return indices == nullptr ? static_cast<std::uint32_t>(i) : indices[i];
    }
};

/// The box of those of list[begin … end - 1] that can be hit.
[[nodiscard]] Bounds3 bounds_of(const TriangleView& view, const TriangleList& list, std::size_t begin,
                                std::size_t end);

/// Stores the cells of list[begin … end - 1] and counts them: the same ranges as `CellMapping::cells_of`.
///
/// @param ranges     one per triangle of the list
/// @param histogram  one count per cell, added to
/// @param limit      stops when there are more references than this
/// @return references counted
std::uint64_t count_cells(const TriangleView& view, const TriangleList& list, std::size_t begin,
                          std::size_t end, const CellMapping& mapping, CellRange* ranges,
                          std::uint32_t* histogram, std::uint64_t limit);

}  // namespace gridreel::rebuild
