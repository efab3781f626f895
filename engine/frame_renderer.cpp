#include "engine/frame_renderer.h"

#include "anim/clip_bounds.h"
#include "anim/frame_geometry.h"
#include "anim/pose.h"
#include "engine/band.h"
#include "engine/choose_lights.h"
#include "engine/notes.h"
#include "engine/pixel_order.h"
#include "engine/render_camera.h"
#include "engine/stopwatch.h"
#include "engine/textures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <utility>

namespace gridreel::engine {
namespace {

void require(bool holds, const char* rule) {
    if (!holds) throw std::invalid_argument(rule);
}

void check(const RenderSettings& settings) {
    require(settings.width >= 1 && settings.width <= largest_picture, "width must be in [1, 65535]");
    require(!settings.height || (*settings.height >= 1 && *settings.height <= largest_picture),
            "height must be in [1, 65535]");
    require(settings.samples >= 1, "samples must be at least 1");
    require(std::isfinite(settings.exposure_stops), "exposure must be finite");
}

/// How many pixels fit a band's rays; whole tiles where possible, so that packets stay square.
std::size_t pixels_per_band(const RenderSettings& settings) {
    constexpr auto tile_pixels = static_cast<std::size_t>(tile_size) * static_cast<std::size_t>(tile_size);
    const std::size_t pixels =
        std::max<std::size_t>(1, settings.rays_per_band / static_cast<std::size_t>(settings.samples));
    return pixels < tile_pixels ? pixels : pixels / tile_pixels * tile_pixels;
}

}  // namespace

struct FrameRenderer::State {
    State(const anim::Scene& scene_of_file, anim::Clip clip_of_scene, const RenderSettings& wishes)
        : scene(scene_of_file),
          clip(std::move(clip_of_scene)),
          settings(wishes),
          textures(scene),
          camera(scene, clip, settings.camera, settings.width, settings.height),
          order(pixel_order(camera.width(), camera.height())),
          pattern{.samples = settings.samples, .seed = settings.seed},
          geometry(anim::lay_out(scene, clip)),
          cut_outs(has_cut_outs(scene, geometry)),
          tracer(traversal::make_tracer(settings.tracer)) {
        choose_lights();
        notes = notes_on_looks(scene, geometry, textures);
        if (settings.camera == "auto" && camera.clip_box()) {
            notes.emplace_back("no camera in the scene: framing the whole clip from the front");
        }
        if (default_lights && settings.lights == LightChoice::automatic) {
            notes.emplace_back("no light in the scene: lit by the default dome and key light");
        }
        if (camera.clip_box() || default_lights) measure_clip();
    }

    void choose_lights() {
        if (settings.lights != LightChoice::standard) lights = light_nodes(scene, clip);
        default_lights = settings.lights == LightChoice::standard ||
                         (settings.lights == LightChoice::automatic && lights.empty());
    }

    void measure_clip() {
        const anim::Box found = camera.clip_box() ? *camera.clip_box() : anim::clip_bounds(scene, clip);
        if (found.empty()) {
            notes.emplace_back("no triangles in the scene: pictures show the background only");
            clip_box.extend(glm::vec3(0.0f));
        } else {
            clip_box = found;
        }
    }

    [[nodiscard]] Lighting lighting_in(const anim::Pose& pose) const {
        return default_lights ? default_lighting(clip_box.min, clip_box.max)
                              : file_lighting(scene, lights, pose);
    }

    // What was decided once.
    const anim::Scene& scene;
    anim::Clip clip;
    RenderSettings settings;
    Textures textures;
    RenderCamera camera;
    std::vector<Pixel> order;
    SamplePattern pattern;
    std::vector<anim::Index> lights;
    bool default_lights = false;
    anim::Box clip_box;
    std::vector<std::string> notes;

    // What every frame overwrites.
    anim::FrameGeometry geometry;
    bool cut_outs = false;
    std::unique_ptr<traversal::Tracer> tracer;
    Band band;
};

FrameRenderer::FrameRenderer(const anim::Scene& scene, anim::Clip clip, const RenderSettings& settings) {
    check(settings);
    state_ = std::make_unique<State>(scene, std::move(clip), settings);
}

FrameRenderer::~FrameRenderer() = default;

FrameReport FrameRenderer::render(double time_s, Film& film) {
    State& s = *state_;
    FrameReport report;

    // Animate.
    const Stopwatch animating;
    const anim::Pose pose = anim::pose(s.scene, s.clip, time_s);
    anim::deform(s.scene, pose, s.geometry);
    report.animate_ms = animating.ms();
    report.moving_triangles = s.geometry.moving_triangles();
    report.still_triangles = s.geometry.triangles.size() - report.moving_triangles;

    // Rebuild.
    report.rebuild =
        s.tracer->rebuild({.positions = s.geometry.positions, .triangles = s.geometry.triangles});

    // Trace and shade, band by band.
    const Stopwatch making_pixels;
    const PosedScene posed{.geometry = s.geometry, .pose = pose, .textures = s.textures};
    const View view = s.camera.view(pose);
    const Lighting lighting = s.lighting_in(pose);
    const Frame frame{.scene = posed,
                      .view = view,
                      .lighting = lighting,
                      .pattern = s.pattern,
                      .tracer = *s.tracer,
                      .background = s.settings.background,
                      .exposure = std::exp2(s.settings.exposure_stops),
                      .cut_outs = s.cut_outs};
    film.resize(s.camera.width(), s.camera.height());
    const std::size_t step = pixels_per_band(s.settings);
    for (std::size_t first = 0; first < s.order.size(); first += step) {
        const auto pixels = std::span(s.order).subspan(first, std::min(step, s.order.size() - first));
        const BandReport band = s.band.render(frame, pixels, film);
        report.primary += band.primary;
        report.shadow += band.shadow;
        report.primary_ms += band.primary_ms;
        report.shadow_ms += band.shadow_ms;
    }
    report.trace_ms = report.primary_ms + report.shadow_ms;
    report.shade_ms = making_pixels.ms() - report.trace_ms;
    return report;
}

std::int32_t FrameRenderer::width() const {
    return state_->camera.width();
}

std::int32_t FrameRenderer::height() const {
    return state_->camera.height();
}

const std::vector<std::string>& FrameRenderer::notes() const {
    return state_->notes;
}

}  // namespace gridreel::engine
