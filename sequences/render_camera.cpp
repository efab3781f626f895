#include "sequences/render_camera.h"

#include "engine/choose_camera.h"
#include "engine/fitting_view.h"
#include "sequences/errors.h"

#include <algorithm>
#include <cmath>

namespace gridreel::sequences {

std::optional<anim::Index> find_camera(const anim::Scene& scene, const anim::Clip& clip,
                                       std::string_view choice) {
    try {
        return engine::choose_camera(scene, clip, choice);
    } catch (const Error& error) {
        throw UsageError(error.what(), "");
    }
}

RenderCamera::RenderCamera(const anim::Scene& scene, const anim::Clip& clip, std::string_view choice,
                           std::int32_t width, std::optional<std::int32_t> height)
    : scene_(scene), node_(find_camera(scene, clip, choice)), width_(width) {
    height_ = height ? *height
                     : std::max(1, static_cast<std::int32_t>(
                                       std::lround(double(width) / engine::preferred_aspect(scene, node_))));
    name_ = node_ ? scene.nodes[*node_].name : "fit";
    if (!node_) bounds_ = anim::clip_bounds(scene, clip);
}

engine::View RenderCamera::view(const anim::Pose& pose) const {
    if (!node_) return engine::fitting_view(bounds_->min, bounds_->max, width_, height_);
    return engine::view_of(pose.cameras[*scene_.nodes[*node_].camera], pose.world[*node_], width_, height_);
}

}  // namespace gridreel::sequences
