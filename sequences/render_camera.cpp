#include "sequences/render_camera.h"

#include "engine/choose_camera.h"
#include "engine/fitting_view.h"
#include "engine/pixel_order.h"
#include "sequences/errors.h"

#include <algorithm>
#include <cmath>

namespace gridreel::sequences {
namespace {

/// Lines for a picture of `width` pixels and an aspect that a file may state as it likes.
std::int32_t height_for(std::int32_t width, double aspect) {
    return static_cast<std::int32_t>(
        std::clamp(std::round(double(width) / aspect), 1.0, double(engine::largest_picture)));
}

/// The box to frame; a scene without triangles is framed as if it were a point at the origin.
anim::Box box_to_frame(const anim::Scene& scene, const anim::Clip& clip) {
    anim::Box box = anim::clip_bounds(scene, clip);
    if (box.empty()) box.extend(glm::vec3(0.0f));
    return box;
}

}  // namespace

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
    height_ = height ? *height : height_for(width, engine::preferred_aspect(scene, node_));
    name_ = node_ ? scene.nodes[*node_].name : "fit";
    if (!node_) bounds_ = box_to_frame(scene, clip);
}

engine::View RenderCamera::view(const anim::Pose& pose) const {
    if (!node_) return engine::fitting_view(bounds_->min, bounds_->max, width_, height_);
    return engine::view_of(pose.cameras[*scene_.nodes[*node_].camera], pose.world[*node_], width_, height_);
}

}  // namespace gridreel::sequences
