#include "engine/still_triangles.h"

#include <cassert>
#include <utility>

namespace gridreel::engine {
namespace {

std::shared_ptr<const rebuild::StillTriangles> still_parts(const anim::FrameGeometry& geometry) {
    std::vector<rebuild::TriangleRun> runs;
    for (const anim::Part& part : geometry.parts) {
        if (part.moves || part.triangle_count == 0) continue;
        const std::size_t end = part.first_triangle + part.triangle_count;
        if (!runs.empty() && runs.back().end == part.first_triangle) {
            runs.back().end = end;
        } else {
            runs.push_back({.begin = part.first_triangle, .end = end});
        }
    }
    if (runs.empty()) return nullptr;
    return std::make_shared<rebuild::StillTriangles>(geometry.triangles.size(), std::move(runs));
}

}  // namespace

std::shared_ptr<const rebuild::StillTriangles> StillInFrames::find(const anim::FrameGeometry& geometry) {
    assert(geometry.posed);
    if (is_shown_ != geometry.is_shown) {
        is_shown_ = geometry.is_shown;
        still_ = still_parts(geometry);
    }
    return still_;
}

}  // namespace gridreel::engine
