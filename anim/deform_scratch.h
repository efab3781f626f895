#pragma once
// What `deform` keeps from frame to frame, so that it allocates nothing once warm.

#include "anim/placement.h"
#include "anim/scene.h"

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <vector>

namespace gridreel::anim {

/// Some vertices of one part: the unit of parallel work.
struct VertexRun {
    Index part = 0;
    std::size_t first = 0;  ///< within the part
    std::size_t count = 0;  ///< at most `longest_run`
};

inline constexpr std::size_t longest_run =
    2048;  ///< vertices; positions and normals of a run fit the L2 cache

/// A part's place in `DeformScratch::maps` and `rows`: one per joint, or one for a rigid part.
struct MapRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// For `deform` alone; laid out by `lay_out`.
struct DeformScratch {
    std::vector<VertexRun> all_runs;     ///< every vertex of every part
    std::vector<VertexRun> moving_runs;  ///< those of moving parts
    std::vector<MapRange> map_ranges;    ///< one per part
    std::vector<Placement> placements;   ///< one per part
    std::vector<glm::dmat4> maps;        ///< file space to world
    std::vector<AffineRows> rows;        ///< `maps`, rounded about each part
    std::vector<bool> is_shown;          ///< one per part
};

}  // namespace gridreel::anim
