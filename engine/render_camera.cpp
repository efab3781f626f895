#include "engine/render_camera.h"

#include "anim/clip_bounds.h"
#include "engine/choose_camera.h"
#include "engine/fitting_view.h"
#include "engine/pixel_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridreel::engine {
namespace {

/// Lines for a picture of `width` pixels and an aspect that a file may state as it likes.
std::int32_t height_for(std::int32_t width, double aspect) {
    return static_cast<std::int32_t>(
        std::clamp(std::round(double(width) / aspect), 1.0, double(largest_picture)));
}

}  // namespace

RenderCamera::RenderCamera(const anim::Scene& scene, const anim::Clip& clip, std::string_view choice,
                           std::int32_t width, std::optional<std::int32_t> height)
    : scene_(scene),
      node_(choose_camera(scene, clip, choice)),
      width_(width),
      height_(height ? *height : height_for(width, preferred_aspect(scene, node_))) {
    if (!node_) clip_box_ = anim::clip_bounds(scene, clip);
}

View RenderCamera::view(const anim::Pose& pose) const {
    if (node_) {
        const anim::Node& node = scene_.nodes[*node_];
        return view_of(pose.cameras[*node.camera], pose.world[*node_], width_, height_,
                       fmt::format("{}: /nodes/{} \"{}\"", scene_.name, *node_, node.name));
    }
    // A scene without triangles is seen as if it were a point at the origin.
    if (clip_box_->empty()) return fitting_view(glm::dvec3(0.0), glm::dvec3(0.0), width_, height_);
    return fitting_view(glm::dvec3(clip_box_->min), glm::dvec3(clip_box_->max), width_, height_);
}

std::string_view RenderCamera::name() const {
    return node_ ? std::string_view(scene_.nodes[*node_].name) : "fit";
}

}  // namespace gridreel::engine
