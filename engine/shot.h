#pragma once
// What is decided once for all frames of a clip: camera, lights, the picture's size and the order of its
// pixels.

#include "anim/clip.h"
#include "anim/clip_bounds.h"
#include "anim/pose.h"
#include "anim/scene.h"
#include "engine/lights.h"
#include "engine/pixel_order.h"
#include "engine/render_camera.h"
#include "engine/render_settings.h"
#include "engine/sample_pattern.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace gridreel::engine {

class Shot {
public:
    /// @param scene  outlives the shot
    /// @throws Error when the camera does not exist; std::invalid_argument when settings break their ranges
    Shot(const anim::Scene& scene, const anim::Clip& clip, const RenderSettings& settings);

    [[nodiscard]] Lighting lighting_in(const anim::Pose& pose) const;

    [[nodiscard]] const RenderCamera& camera() const { return camera_; }
    [[nodiscard]] const SamplePattern& pattern() const { return pattern_; }

    /// The picture in runs of `pixel_order`, each with as many pixels as `rays_per_band` allows.
    [[nodiscard]] std::size_t band_count() const;
    [[nodiscard]] std::span<const Pixel> band(std::size_t index) const;

    /// Of the whole picture.
    [[nodiscard]] std::size_t camera_ray_count() const;

    /// What was decided without being asked ("no light in the scene: …"), a sentence each.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

private:
    void measure(const anim::Clip& clip);

    const anim::Scene& scene_;
    RenderCamera camera_;
    std::vector<anim::Index> lights_;
    bool default_lights_ = false;
    anim::Box clip_box_;
    SamplePattern pattern_;
    std::vector<Pixel> order_;
    std::size_t pixels_per_band_ = 1;
    std::vector<std::string> notes_;
};

}  // namespace gridreel::engine
