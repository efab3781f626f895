#include "engine/shot.h"

#include "engine/choose_lights.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gridreel::engine {
namespace {

void require(bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument(rule);
}

const RenderSettings& checked(const RenderSettings& settings) {
    require(settings.width >= 1 && settings.width <= largest_picture, "width must be in [1, 65535]");
    require(!settings.height || (*settings.height >= 1 && *settings.height <= largest_picture),
            "height must be in [1, 65535]");
    require(settings.samples >= 1, "samples must be at least 1");
    require(std::isfinite(settings.exposure_stops), "exposure must be finite");
    return settings;
}

/// How many pixels fit a band's rays; whole tiles where possible, so that packets stay square.
std::size_t pixels_per_band(const RenderSettings& settings) {
    constexpr auto tile_pixels = static_cast<std::size_t>(tile_size) * static_cast<std::size_t>(tile_size);
    const std::size_t pixels =
        std::max<std::size_t>(1, settings.rays_per_band / static_cast<std::size_t>(settings.samples));
    return pixels < tile_pixels ? pixels : pixels / tile_pixels * tile_pixels;
}

}  // namespace

Shot::Shot(const anim::Scene& scene, const anim::Clip& clip, const RenderSettings& settings)
    : scene_(scene),
      camera_(scene, clip, settings.camera, checked(settings).width, settings.height),
      pattern_{.samples = settings.samples, .seed = settings.seed},
      order_(pixel_order(camera_.width(), camera_.height())),
      pixels_per_band_(pixels_per_band(settings)) {
    if (settings.lights != LightChoice::standard) lights_ = light_nodes(scene, clip);
    default_lights_ = settings.lights == LightChoice::standard ||
                      (settings.lights == LightChoice::automatic && lights_.empty());

    if (settings.camera == "auto" && camera_.clip_box()) {
        notes_.emplace_back("no camera in the scene: framing the whole clip from the front");
    }
    if (default_lights_ && settings.lights == LightChoice::automatic) {
        notes_.emplace_back("no light in the scene: lit by the default dome and key light");
    }
    if (camera_.clip_box() || default_lights_) measure(clip);
}

void Shot::measure(const anim::Clip& clip) {
    const anim::Box found = camera_.clip_box() ? *camera_.clip_box() : anim::clip_bounds(scene_, clip);
    if (found.empty()) {
        notes_.emplace_back("no triangles in the scene: pictures show the background only");
        clip_box_.extend(glm::vec3(0.0f));
    } else {
        clip_box_ = found;
    }
}

Lighting Shot::lighting_in(const anim::Pose& pose) const {
    return default_lights_ ? default_lighting(clip_box_.min, clip_box_.max)
                           : file_lighting(scene_, lights_, pose);
}

std::size_t Shot::band_count() const {
    return (order_.size() + pixels_per_band_ - 1) / pixels_per_band_;
}

std::span<const Pixel> Shot::band(std::size_t index) const {
    const std::size_t first = index * pixels_per_band_;
    return std::span(order_).subspan(first, std::min(pixels_per_band_, order_.size() - first));
}

std::size_t Shot::camera_ray_count() const {
    return order_.size() * static_cast<std::size_t>(pattern_.samples);
}

}  // namespace gridreel::engine
