#pragma once
// Telling those who rebuild which triangles of a clip stand still.

#include "anim/frame_geometry.h"
#include "rebuild/still_triangles.h"

#include <memory>

namespace gridreel::engine {

/// For all frames of the clip that `geometry` was laid out for; nullptr if everything in it moves.
[[nodiscard]] std::shared_ptr<const rebuild::StillTriangles> find_still(const anim::FrameGeometry& geometry);

}  // namespace gridreel::engine
