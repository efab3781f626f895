#pragma once
// How much memory a render will need, from what is in the scene.

#include "anim/box.h"
#include "anim/frame_geometry.h"
#include "anim/scene.h"
#include "engine/frame_renderer.h"

#include <cstddef>

namespace gridreel::sequences {

/// Bytes that a render holds at once, by what they are for.
struct MemoryEstimate {
    std::size_t program = 0;               ///< the program and its libraries, the same for every scene
    std::size_t scene = 0;                 ///< the file as read: meshes, keys, encoded images
    std::size_t geometry = 0;              ///< the triangles of a frame, posed
    std::size_t textures = 0;              ///< the images of materials, decoded, at every size
    std::size_t grid = 0;                  ///< cells and references, and what rebuilding them takes
    std::size_t films = 0;                 ///< frames rendered, waiting and written
    std::size_t rays = 0;                  ///< a band of camera and shadow rays, if all of them hit something
    double references_per_triangle = 0.0;  ///< assumed for the grid

    [[nodiscard]] std::size_t total() const {
        return program + scene + geometry + textures + grid + films + rays;
    }
};

/// Cells that a triangle is listed in on average, when `triangle_count` triangles of one size cover one face
/// of a box that is a cube with `lambda` cells per triangle: (1 + edge / cell)^3, at most what
/// `rebuild::GridBuilder` allows. Real scenes have half to twice as many.
[[nodiscard]] double assumed_references_per_triangle(std::size_t triangle_count, double lambda);

/// @param geometry  laid out for the clip
/// @param bounds    over the clip
/// @param settings  their height, when absent, counts as that of 16:9
/// @param threads   of the render, >= 1
[[nodiscard]] MemoryEstimate estimate_memory(const anim::Scene& scene, const anim::FrameGeometry& geometry,
                                             const anim::Box& bounds, const engine::RenderSettings& settings,
                                             int threads);

}  // namespace gridreel::sequences
