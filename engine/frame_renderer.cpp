#include "engine/frame_renderer.h"

#include "anim/frame_geometry.h"
#include "anim/pose.h"
#include "engine/band.h"
#include "engine/notes.h"
#include "engine/shot.h"
#include "engine/still_triangles.h"
#include "engine/stopwatch.h"
#include "engine/textures.h"
#include "traversal/lambda_chooser.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace gridreel::engine {
namespace {

traversal::MeasuredFrame measured_frame(const FrameReport& report) {
    traversal::TraceReport traced = report.primary;
    traced += report.shadow;
    return traversal::measured_frame(report.moving_triangles + report.still_triangles, report.rebuild, traced,
                                     report.trace_ms);
}

}  // namespace

struct FrameRenderer::State {
    State(const anim::Scene& scene_of_file, anim::Clip clip_of_scene, const RenderSettings& wishes)
        : scene(scene_of_file),
          clip(std::move(clip_of_scene)),
          settings(wishes),
          textures(scene),
          shot(scene, clip, settings),
          geometry(anim::lay_out(scene, clip)),
          cut_outs(has_cut_outs(scene, geometry)),
          tracer(traversal::make_tracer(settings.tracer)),
          lambda(traversal::make_lambda_chooser(settings.tracer, shot.camera_ray_count())),
          notes(notes_on(scene, geometry, textures, shot)) {}

    // What was decided once.
    const anim::Scene& scene;
    anim::Clip clip;
    RenderSettings settings;
    Textures textures;
    Shot shot;

    // What every frame overwrites.
    anim::FrameGeometry geometry;
    StillInFrames still;
    bool cut_outs = false;
    std::unique_ptr<traversal::Tracer> tracer;
    std::optional<traversal::LambdaChooser> lambda;
    Band band;

    std::vector<std::string> notes;
};

FrameRenderer::FrameRenderer(const anim::Scene& scene, anim::Clip clip, const RenderSettings& settings) {
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
    const auto still = s.still.find(s.geometry);
    report.animate_ms = animating.ms();
    report.moving_triangles = s.geometry.moving_triangles();
    report.still_triangles = s.geometry.triangles.size() - report.moving_triangles;

    // Rebuild.
    if (s.lambda) {
        const traversal::LambdaChoice choice = s.lambda->choose(s.geometry.triangles.size());
        s.tracer->set_lambda(choice.lambda);
        report.predicted = choice.predicted;
    }
    report.rebuild = s.tracer->rebuild(
        {.positions = s.geometry.positions, .triangles = s.geometry.triangles, .still = still});

    // Trace and shade, band by band.
    const Stopwatch making_pixels;
    const PosedScene posed{.geometry = s.geometry, .pose = pose, .textures = s.textures};
    const View view = s.shot.camera().view(pose);
    const Lighting lighting = s.shot.lighting_in(pose);
    const Frame frame{.scene = posed,
                      .view = view,
                      .lighting = lighting,
                      .pattern = s.shot.pattern(),
                      .tracer = *s.tracer,
                      .background = s.settings.background,
                      .exposure = std::exp2(s.settings.exposure_stops),
                      .cut_outs = s.cut_outs};
    film.resize(s.settings.width, s.shot.camera().height());
    for (std::size_t i = 0; i < s.shot.band_count(); ++i) {
        const std::span<const Pixel> pixels = s.shot.band(i);
        const BandReport band = s.band.render(frame, pixels, film);
        report.primary += band.primary;
        report.shadow += band.shadow;
        report.primary_ms += band.primary_ms;
        report.shadow_ms += band.shadow_ms;
    }
    report.trace_ms = report.primary_ms + report.shadow_ms;
    report.shade_ms = making_pixels.ms() - report.trace_ms;
    if (s.lambda) s.lambda->measured(report.rebuild.lambda, measured_frame(report));
    return report;
}

std::int32_t FrameRenderer::width() const {
    return state_->settings.width;
}

std::int32_t FrameRenderer::height() const {
    return state_->shot.camera().height();
}

const std::vector<std::string>& FrameRenderer::notes() const {
    return state_->notes;
}

}  // namespace gridreel::engine
