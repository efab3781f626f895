#pragma once
// A parametric surface and its morph targets, sampled into a grid of triangles.

#include "tools/gallery/document.h"

#include <glm/gtc/type_precision.hpp>

#include <functional>
#include <span>
#include <string>

namespace gridreel::gallery {

/// A surface over the unit square and how its morph targets displace it.
struct MorphSurface {
    /// Fills `out`: the point at (u, v), then each target's displacement there. Smooth, also a little
    /// outside the square; called from several threads.
    std::function<void(double u, double v, std::span<glm::dvec3> out)> at;
    std::function<glm::dvec3(double u, double v)> color;  ///< linear RGB
    std::size_t target_count = 0;
    double aspect = 1.0;  ///< length along u over length along v: quads come out about square
    bool wraps = false;   ///< u = 1 is u = 0 and v = 1 is v = 0: no seam
};

/// Quads along u and v.
struct GridSize {
    std::uint32_t columns = 1, rows = 1;
};

/// The grid nearest to `triangles` triangles whose quads are about square.
/// @param least  columns and rows are at least this many (3 for a surface that wraps)
[[nodiscard]] GridSize choose_grid(std::size_t triangles, double aspect, std::uint32_t least);

/// Samples the surface and adds it as a mesh with morph targets of positions and normals.
///
/// u runs to the right and v up when seen from outside. Normals are the cross product of the tangents;
/// a target's normals are its first-order change, so that adding weighted targets and normalising again
/// gives the displaced surface's normal up to second order in the displacement.
[[nodiscard]] Id add_morph_mesh(Document& document, std::string name, const MorphSurface& surface,
                                const GridSize& size, Id material);

}  // namespace gridreel::gallery
