#pragma once
// The camera that the pictures of a clip are taken with.

#include "anim/box.h"
#include "anim/clip.h"
#include "anim/pose.h"
#include "anim/scene.h"
#include "engine/camera.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gridreel::engine {

/// A camera node, or a view that fits the whole clip, for pictures of one size.
class RenderCamera {
public:
    /// @param scene   outlives the camera
    /// @param choice  as `choose_camera`
    /// @param width   pixels, >= 1
    /// @param height  pixels, >= 1; absent: from `width` and the aspect that the camera asks for, in
    ///                [1, largest_picture]
    /// @throws Error when the camera does not exist
    RenderCamera(const anim::Scene& scene, const anim::Clip& clip, std::string_view choice,
                 std::int32_t width, std::optional<std::int32_t> height);

    /// @throws Error as `view_of`
    [[nodiscard]] View view(const anim::Pose& pose) const;

    [[nodiscard]] std::int32_t width() const { return width_; }
    [[nodiscard]] std::int32_t height() const { return height_; }
    [[nodiscard]] double aspect() const { return double(width_) / height_; }  ///< of the picture
    [[nodiscard]] std::string_view name() const;  ///< the node's; "fit" without one

    /// The clip's bounds when there is no node, or else nothing.
    [[nodiscard]] const std::optional<anim::Box>& clip_box() const { return clip_box_; }

private:
    const anim::Scene& scene_;
    std::optional<anim::Index> node_;
    std::optional<anim::Box> clip_box_;
    std::int32_t width_;
    std::int32_t height_;
};

}  // namespace gridreel::engine
