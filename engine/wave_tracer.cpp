#include "engine/wave_tracer.h"

#include "anim/frame_geometry.h"
#include "anim/pose.h"
#include "engine/bounce_rays.h"
#include "engine/camera_rays.h"
#include "engine/compact.h"
#include "engine/hit_point.h"
#include "engine/shadow_rays.h"
#include "engine/shot.h"
#include "engine/still_triangles.h"
#include "engine/stopwatch.h"
#include "engine/surface.h"
#include "rebuild/buffer.h"

#include <oneapi/tbb/parallel_for.h>

#include <span>
#include <utility>

namespace gridreel::engine {
namespace {

/// The same place of the picture bounces the same way, in whatever band it is.
std::uint32_t bounce_seed(std::span<const Pixel> pixels, std::int32_t samples, std::size_t ray) {
    const auto count = static_cast<std::size_t>(samples);
    const Pixel pixel = pixels[ray / count];
    return (std::uint32_t{pixel.y} << 16u | pixel.x) * static_cast<std::uint32_t>(samples) +
           static_cast<std::uint32_t>(ray % count);
}

}  // namespace

struct WaveTracer::State {
    State(const anim::Scene& scene_of_file, anim::Clip clip_of_scene, const RenderSettings& settings)
        : scene(scene_of_file),
          clip(std::move(clip_of_scene)),
          shot(scene, clip, settings),
          geometry(anim::lay_out(scene, clip)),
          pose(anim::pose(scene, clip, 0.0)) {}

    void trace_primary(traversal::Tracer& tracer, std::span<const Pixel> pixels, const View& view,
                       WaveReport& report);
    void find_surfaces();
    void trace_shadow(traversal::Tracer& tracer, const PosedLight& light, WaveReport& report);
    void trace_bounce(traversal::Tracer& tracer, std::span<const Pixel> pixels, WaveReport& report);

    const anim::Scene& scene;
    anim::Clip clip;
    Shot shot;
    anim::FrameGeometry geometry;
    StillInFrames still_in_frames;
    std::shared_ptr<const rebuild::StillTriangles> still;  ///< as posed last
    anim::Pose pose;

    // One entry per camera ray.
    traversal::RayBatch camera_rays;
    traversal::HitBatch hits;
    rebuild::Buffer<SurfaceShape> surfaces;  ///< unspecified where nothing was hit

    // One entry per camera ray that the next wave goes on from.
    rebuild::Buffer<std::uint8_t> marks;
    rebuild::Buffer<std::uint32_t> sample_of;
    traversal::RayBatch rays;
    traversal::HitBatch bounce_hits;
    traversal::OcclusionBatch occluded;
};

void WaveTracer::State::trace_primary(traversal::Tracer& tracer, std::span<const Pixel> pixels,
                                      const View& view, WaveReport& report) {
    const Stopwatch making;
    make_camera_rays(view, shot.pattern(), pixels, camera_rays);
    report.making_ms += making.ms();

    tracer.take_way(0);
    const Stopwatch tracing;
    const traversal::TraceReport cost = tracer.closest_hits(camera_rays, hits);
    report.primary += {.report = cost, .ms = tracing.ms()};
}

void WaveTracer::State::find_surfaces() {
    surfaces.resize(camera_rays.size());
    tbb::parallel_for(std::size_t{0}, camera_rays.size(), [&](std::size_t i) {
        const std::uint32_t triangle = hits.triangle[i];
        if (triangle == traversal::no_triangle) return;
        const Ray ray{.origin = camera_rays.origin_of(i), .direction = camera_rays.direction_of(i)};
        surfaces[i] = shape_at(geometry, triangle, hit_point(geometry, triangle, ray), ray);
    });
}

void WaveTracer::State::trace_shadow(traversal::Tracer& tracer, const PosedLight& light, WaveReport& report) {
    const Stopwatch making;
    marks.resize(camera_rays.size());
    tbb::parallel_for(std::size_t{0}, camera_rays.size(), [&](std::size_t i) {
        marks[i] = hits.triangle[i] != traversal::no_triangle && may_light(light, surfaces[i]);
    });
    compact(marks, sample_of);
    begin_shadow_rays(light, sample_of.size(), rays);
    tbb::parallel_for(std::size_t{0}, sample_of.size(),
                      [&](std::size_t i) { set_shadow_ray(light, surfaces[sample_of[i]], i, rays); });
    report.making_ms += making.ms();

    for (std::size_t way = 0; way < report.shadow.size(); ++way) {
        tracer.take_way(way);
        const Stopwatch tracing;
        const traversal::TraceReport cost = tracer.any_hits(rays, occluded);
        report.shadow[way] += {.report = cost, .ms = tracing.ms()};
    }
}

void WaveTracer::State::trace_bounce(traversal::Tracer& tracer, std::span<const Pixel> pixels,
                                     WaveReport& report) {
    const Stopwatch making;
    marks.resize(camera_rays.size());
    tbb::parallel_for(std::size_t{0}, camera_rays.size(),
                      [&](std::size_t i) { marks[i] = hits.triangle[i] != traversal::no_triangle; });
    compact(marks, sample_of);
    rays.resize(sample_of.size(), std::nullopt, traversal::RayOrder::arbitrary);
    tbb::parallel_for(std::size_t{0}, sample_of.size(), [&](std::size_t i) {
        const std::size_t sample = sample_of[i];
        set_bounce_ray(surfaces[sample], bounce_seed(pixels, shot.pattern().samples, sample), i, rays);
    });
    report.making_ms += making.ms();

    for (std::size_t way = 0; way < report.bounce.size(); ++way) {
        tracer.take_way(way);
        const Stopwatch tracing;
        const traversal::TraceReport cost = tracer.closest_hits(rays, bounce_hits);
        report.bounce[way] += {.report = cost, .ms = tracing.ms()};
    }
}

WaveTracer::WaveTracer(const anim::Scene& scene, anim::Clip clip, const RenderSettings& settings)
    : state_(std::make_unique<State>(scene, std::move(clip), settings)) {}

WaveTracer::~WaveTracer() = default;

double WaveTracer::animate(double time_s) {
    State& s = *state_;
    const Stopwatch animating;
    s.pose = anim::pose(s.scene, s.clip, time_s);
    anim::deform(s.scene, s.pose, s.geometry);
    s.still = s.still_in_frames.find(s.geometry);
    return animating.ms();
}

rebuild::BuildReport WaveTracer::rebuild(traversal::Tracer& tracer) const {
    const State& s = *state_;
    return tracer.rebuild(
        {.positions = s.geometry.positions, .triangles = s.geometry.triangles, .still = s.still});
}

WaveReport WaveTracer::trace(traversal::Tracer& tracer, Bounce bounce) {
    State& s = *state_;
    WaveReport report;
    report.shadow.resize(tracer.ways().size());
    if (bounce == Bounce::traced) report.bounce.resize(tracer.ways().size());
    const View view = s.shot.camera().view(s.pose);
    const Lighting lighting = s.shot.lighting_in(s.pose);
    for (std::size_t i = 0; i < s.shot.band_count(); ++i) {
        const std::span<const Pixel> pixels = s.shot.band(i);
        s.trace_primary(tracer, pixels, view, report);
        const Stopwatch finding;
        s.find_surfaces();
        report.making_ms += finding.ms();
        for (const PosedLight& light : lighting.lights) s.trace_shadow(tracer, light, report);
        if (bounce == Bounce::traced) s.trace_bounce(tracer, pixels, report);
    }
    return report;
}

std::size_t WaveTracer::moving_triangles() const {
    return state_->geometry.moving_triangles();
}

std::size_t WaveTracer::still_triangles() const {
    return state_->geometry.triangles.size() - moving_triangles();
}

std::size_t WaveTracer::camera_ray_count() const {
    return state_->shot.camera_ray_count();
}

const std::vector<std::string>& WaveTracer::notes() const {
    return state_->shot.notes();
}

}  // namespace gridreel::engine
