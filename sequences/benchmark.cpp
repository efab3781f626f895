#include "sequences/benchmark.h"

#include "sequences/frame_pattern.h"
#include "traversal/lambda_chooser.h"

#include <tbb/task_arena.h>

#include <memory>
#include <optional>
#include <utility>

namespace gridreel::sequences {
namespace {

constexpr int settling_runs = 16;  // a little over twice the λ there are to choose from

std::size_t triangles_of(const engine::WaveTracer& waves) {
    return waves.moving_triangles() + waves.still_triangles();
}

/// A competitor's own structure, kept from frame to frame.
struct Entrant {
    std::unique_ptr<traversal::Tracer> tracer;
    std::unique_ptr<tbb::task_arena> arena;
    rebuild::BuildReport built;  ///< last
    std::optional<traversal::LambdaChooser> lambda;

    void rebuild(const engine::WaveTracer& waves) {
        if (lambda) tracer->set_lambda(lambda->choose(triangles_of(waves)).lambda);
        built = waves.rebuild(*tracer);
    }

    /// Tells the chooser what the frame took.
    void learn(const engine::WaveTracer& waves, const engine::WaveReport& traced) {
        if (!lambda) return;
        traversal::TraceReport rays = traced.primary.report;
        rays += traced.shadow.front().report;
        const double ms = traced.primary.ms + traced.shadow.front().ms;
        lambda->measured(built.lambda, traversal::measured_frame(triangles_of(waves), built, rays, ms));
    }

    /// Rebuilds and traces the frame as often as λ takes to settle.
    void settle(engine::WaveTracer& waves) {
        for (int run = 0; lambda && run < settling_runs; ++run) {
            rebuild(waves);
            learn(waves, waves.trace(*tracer, engine::Bounce::left_out));
        }
    }
};

std::vector<Entrant> enter(const BenchmarkPlan& plan, std::size_t camera_rays,
                           std::vector<Competitor>& competitors) {
    std::vector<Entrant> entrants;
    for (const int threads : plan.threads) {
        for (const NamedTracer& tracer : plan.tracers) {
            Entrant& entrant = entrants.emplace_back(
                Entrant{.tracer = traversal::make_tracer(tracer.options),
                        .arena = std::make_unique<tbb::task_arena>(threads),
                        .built = {},
                        .lambda = traversal::make_lambda_chooser(tracer.options, camera_rays)});
            Competitor& competitor = competitors.emplace_back(
                Competitor{.name = tracer.name, .threads = threads, .ways = {}, .runs = {}});
            for (const std::string_view way : entrant.tracer->ways()) competitor.ways.emplace_back(way);
        }
    }
    return entrants;
}

}  // namespace

SceneBenchmark run_benchmark(const BenchmarkPlan& plan,
                             const std::function<void(std::size_t, std::size_t)>& frame_done) {
    const anim::Scene scene = load_scene(plan.take).scene;
    const anim::Clip clip = choose_clip(scene, plan.take);
    const std::vector<Frame> frames = choose_frames(plan.take, scene, clip, FramePattern("none.####.exr"));
    check_camera(scene, clip, plan.render.camera);

    engine::WaveTracer waves(scene, clip, plan.render);
    SceneBenchmark result{.scene = plan.take.scene_file.stem().string(),
                          .frames = frames.size(),
                          .phase = plan.phase,
                          .competitors = {},
                          .notes = waves.notes()};
    std::vector<Entrant> entrants = enter(plan, waves.camera_ray_count(), result.competitors);

    // The clip's start.
    (void)waves.animate(0.0);
    result.moving_triangles = waves.moving_triangles();
    result.still_triangles = waves.still_triangles();
    for (Entrant& entrant : entrants) entrant.arena->execute([&] { (void)waves.rebuild(*entrant.tracer); });

    // Frame by frame, run by run, in turns.
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const double time_s = plan.take.rate.time_of(frames[f]);
        const auto measure = [&](Entrant& entrant, bool first_run) {
            BenchmarkRun run;
            if (plan.phase != BenchmarkPhase::trace || first_run) {
                run.animate_ms = waves.animate(time_s);
                entrant.rebuild(waves);
            }
            run.rebuild = entrant.built;
            if (plan.phase != BenchmarkPhase::rebuild) run.waves = waves.trace(*entrant.tracer, plan.bounce);
            if (plan.phase == BenchmarkPhase::all) entrant.learn(waves, run.waves);
            return run;
        };
        if (f == 0 && plan.warmup > 0) {
            (void)waves.animate(time_s);
            for (Entrant& entrant : entrants) entrant.arena->execute([&] { entrant.settle(waves); });
        }
        const std::size_t count = entrants.size();
        for (int turn = 0; turn < plan.warmup + plan.repeat; ++turn) {
            for (std::size_t place = 0; place < count; ++place) {
                const std::size_t c = (place + static_cast<std::size_t>(turn)) % count;
                BenchmarkRun run;
                entrants[c].arena->execute([&] { run = measure(entrants[c], turn == 0); });
                if (turn >= plan.warmup) result.competitors[c].runs.push_back(std::move(run));
            }
        }
        frame_done(f + 1, frames.size());
    }
    return result;
}

}  // namespace gridreel::sequences
