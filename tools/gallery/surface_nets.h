#pragma once
// Triangles of an implicit surface, by naive surface nets (Gibson 1998): a vertex in every grid cell
// that the surface crosses, a quad across every grid edge that it crosses.

#include "tools/gallery/mesh_shapes.h"

#include <functional>

namespace gridreel::gallery {

/// A solid: negative inside, positive outside, never steeper than a true distance.
struct Solid {
    std::function<double(const glm::dvec3&)> distance;  ///< metres; called from several threads
    glm::dvec3 low, high;                               ///< a box around it
};

/// The solid's surface on a grid of cubes of side `cell_m`, vertices moved onto the surface, normals from
/// the gradient. Without holes; where the solid is only a cell or two thick, four triangles may meet at
/// an edge.
///
/// Time and memory follow the surface's area, not the volume: blocks of cells far from it are
/// recognised by one distance each.
[[nodiscard]] Shape polygonise(const Solid& solid, double cell_m);

/// `polygonise` with the cell size that gives about `triangles` triangles (within 2 % from about 1000 on).
/// @param largest_cell_m  never coarser than this, however few triangles are asked for
[[nodiscard]] Shape polygonise_to_count(const Solid& solid, std::size_t triangles, double largest_cell_m);

}  // namespace gridreel::gallery
