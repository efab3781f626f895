#pragma once
// Sheets modelled as two coinciding sides: which triangle has another in its place that faces the other way.

#include "anim/frame_geometry.h"
#include "anim/scene.h"

#include <cstdint>
#include <vector>

namespace gridreel::engine {

/// Pairs of triangles of one node with the same corners and opposite windings. A ray meets both at the same
/// distance, and a tracer answers with only one of them: if that one's back is not drawn, its twin is.
class TwinTriangles {
public:
    /// Looks among the triangles of single-sided materials, before they are posed.
    TwinTriangles(const anim::Scene& scene, const anim::FrameGeometry& geometry);

    /// The triangle's twin, or `traversal::no_triangle` when it has none or the pose has moved them apart.
    [[nodiscard]] std::uint32_t twin_of(const anim::FrameGeometry& geometry, std::uint32_t triangle) const;

private:
    std::vector<std::uint32_t> twins_;  ///< one per triangle; empty when there are no twins at all
};

}  // namespace gridreel::engine
