#pragma once
// The acceleration structure: a uniform grid with one list of triangles per cell.

#include "rebuild/bounds.h"
#include "rebuild/buffer.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// A uniform grid in compact form (Lagae & Dutre 2008): cell c lists the triangles
/// `references[cell_begin[c]] … references[cell_begin[c + 1] - 1]`, in ascending order.
/// Cells are numbered x fastest, so neighbours along x are one contiguous span of references.
///
/// A triangle is listed in every cell its bounding box comes within `slack` of, so whoever walks the grid
/// may be wrong by that much about where a point lies.
struct Grid {
    Bounds3 bounds;                    ///< of all triangles with finite corners, padded; empty: no cells
    glm::ivec3 resolution{0};          ///< cells per axis
    glm::dvec3 cell_size{0.0};         ///< metres
    glm::dvec3 slack{0.0};             ///< metres, along each axis
    Buffer<std::uint32_t> cell_begin;  ///< one per cell, and one more
    Buffer<std::uint32_t> references;  ///< triangle indices

    [[nodiscard]] std::size_t cell_count() const {
        return static_cast<std::size_t>(resolution.x) * static_cast<std::size_t>(resolution.y) *
               static_cast<std::size_t>(resolution.z);
    }
};

}  // namespace gridreel::rebuild
