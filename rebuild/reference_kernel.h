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

/// Set on the cell of a triangle's first reference. Cells have lower numbers.
inline constexpr std::uint32_t next_triangle = std::uint32_t{1} << 31;

/// Room for references. They lie triangle after triangle, so a mark on the first of each is enough to tell
/// whose they are: half as much memory as the number of its triangle beside every cell.
struct ReferenceRoom {
    /// Kernels write whole SIMD registers: so much behind the last reference may be overwritten.
    static constexpr std::size_t padding = 16;

    std::uint32_t* cells = nullptr;      ///< one per reference, with marks
    std::uint32_t* triangles = nullptr;  ///< those that have references; room for all that are looked at
    std::size_t capacity = 0;            ///< references, and `padding` more
};

/// The box of those of list[begin … end - 1] that can be hit.
[[nodiscard]] Bounds3 bounds_of(const TriangleView& view, const TriangleList& list, std::size_t begin,
                                std::size_t end);

/// Finds the cells of list[begin … end - 1], triangle after triangle: those of `CellMapping::cells_of`, less,
/// for triangles across many cells, most of those that no point of the triangle comes within
/// `CellMapping::slack` of. The same cells on every machine; those of one triangle in any order.
///
/// @param room   gets the references if they fit
/// @param limit  stops when there are more references than this
/// @return references found, whether or not there was room for all of them
std::uint64_t find_references(const TriangleView& view, const TriangleList& list, std::size_t begin,
                              std::size_t end, const CellMapping& mapping, const ReferenceRoom& room,
                              std::uint64_t limit);

}  // namespace gridreel::rebuild
