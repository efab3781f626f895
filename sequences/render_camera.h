#pragma once
// Where the render camera stands at a time.

#include "anim/clip.h"
#include "anim/clip_bounds.h"
#include "anim/pose.h"
#include "anim/scene.h"
#include "engine/camera.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gridreel::sequences {

/// `engine::choose_camera`, but a camera that does not exist is the caller's mistake.
/// @throws UsageError
[[nodiscard]] std::optional<anim::Index> find_camera(const anim::Scene& scene, const anim::Clip& clip,
                                                     std::string_view choice);

/// The camera that `engine::FrameRenderer` would take for the same arguments.
class RenderCamera {
public:
    /// @param choice  as `engine::RenderSettings::camera`
    /// @param width   pixels
    /// @param height  pixels; absent: from `width` and the camera's aspect
    /// @throws UsageError when the camera does not exist
    RenderCamera(const anim::Scene& scene, const anim::Clip& clip, std::string_view choice,
                 std::int32_t width, std::optional<std::int32_t> height);

    [[nodiscard]] engine::View view(const anim::Pose& pose) const;
    [[nodiscard]] std::string_view name() const { return name_; }  ///< the node's; "fit" without one
    [[nodiscard]] double aspect() const { return double(width_) / height_; }  ///< of the picture

private:
    const anim::Scene& scene_;
    std::optional<anim::Index> node_;
    std::string name_;
    std::int32_t width_;
    std::int32_t height_;
    std::optional<anim::Box> bounds_;  ///< of the clip, when there is no node
};

}  // namespace gridreel::sequences
