#pragma once
// The acceleration structure: a uniform grid with one list of triangles per cell, crowded cells grids of
// their own.

#include "rebuild/bounds.h"
#include "rebuild/buffer.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// Where one grid's cells lie, in the world and among the cells of its level. Cells are numbered x fastest,
/// so neighbours along x are one contiguous span of references.
///
/// A triangle is listed in every cell that some point of it comes within `slack` of, so whoever walks the
/// grid may be wrong by that much about where a point lies; and in no cell that its bounding box does not.
struct UniformGrid {
    Bounds3 bounds;             ///< padded; empty: no cells
    glm::ivec3 resolution{0};   ///< cells per axis
    glm::dvec3 cell_size{0.0};  ///< metres
    glm::dvec3 slack{0.0};      ///< metres, along each axis
    double least_slack = 0.0;   ///< metres, the same for all grids of a frame
    std::size_t first_cell = 0;

    [[nodiscard]] std::size_t cell_count() const {
        return static_cast<std::size_t>(resolution.x) * static_cast<std::size_t>(resolution.y) *
               static_cast<std::size_t>(resolution.z);
    }
};

/// All grids of one depth of nesting, in compact form (Lagae & Dutre 2008): cell c of the level lists the
/// triangles `references[cell_begin[c]] … references[cell_begin[c + 1] - 1]`, in ascending order.
///
/// A crowded cell is a grid of the next level instead: its first reference is then `nested_mark | index of
/// that grid`, its second how many references the cell takes up. A level that nothing is nested in is
/// empty.
struct GridLevel {
    Buffer<UniformGrid> grids;
    Buffer<std::uint32_t> cell_begin;  ///< one per cell, grid after grid, and one more
    Buffer<std::uint32_t> references;  ///< triangle indices, and marks

    [[nodiscard]] std::size_t bytes() const {
        return grids.bytes() + cell_begin.bytes() + references.bytes();
    }
    [[nodiscard]] std::size_t used_bytes() const {
        return grids.used_bytes() + cell_begin.used_bytes() + references.used_bytes();
    }
    void clear() {
        grids.resize(0);
        cell_begin.resize(0);
        references.resize(0);
    }
    void begin_frame() {
        grids.begin_frame();
        cell_begin.begin_frame();
        references.begin_frame();
    }
};

/// Set on a reference that stands for a nested grid. Triangles have lower indices.
inline constexpr std::uint32_t nested_mark = std::uint32_t{1} << 31;

inline constexpr std::size_t deepest_nesting = 3;

/// A uniform grid, and the grids nested in its crowded cells.
struct Grid {
    std::array<GridLevel, 1 + deepest_nesting> levels;  ///< the first holds one grid: the top

    [[nodiscard]] bool empty() const { return levels[0].grids.empty(); }
    [[nodiscard]] const UniformGrid& top() const { return levels[0].grids[0]; }
};

}  // namespace gridreel::rebuild
