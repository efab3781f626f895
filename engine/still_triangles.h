#pragma once
// Telling those who rebuild which triangles of a clip stand still.

#include "anim/frame_geometry.h"
#include "rebuild/still_triangles.h"

#include <memory>
#include <vector>

namespace gridreel::engine {

/// Which triangles of a clip stand still, as long as the same parts are shown.
///
/// Parts that come and go give other triangles other numbers, so nothing is said from the frame before such
/// a change to the one after it: what stands still is an object of its own then.
class StillInFrames {
public:
    /// @param geometry  deformed; of the same clip in every call
    /// @return nullptr if everything in it moves
    [[nodiscard]] std::shared_ptr<const rebuild::StillTriangles> find(const anim::FrameGeometry& geometry);

private:
    std::vector<bool> is_shown_;  ///< in the frame that `still_` was found in
    std::shared_ptr<const rebuild::StillTriangles> still_;
};

}  // namespace gridreel::engine
