#include "sequences/benchmark.h"

#include "anim/load.h"
#include "sequences/frame_pattern.h"

#include <tbb/task_arena.h>

#include <memory>
#include <utility>

namespace gridreel::sequences {
namespace {

/// A competitor's own structure, kept from frame to frame.
struct Entrant {
    std::unique_ptr<traversal::Tracer> tracer;
    std::unique_ptr<tbb::task_arena> arena;
    rebuild::BuildReport built;  ///< last
};

std::vector<Entrant> enter(const BenchmarkPlan& plan, std::vector<Competitor>& competitors) {
    std::vector<Entrant> entrants;
    for (const int threads : plan.threads) {
        for (const NamedTracer& tracer : plan.tracers) {
            Entrant& entrant =
                entrants.emplace_back(Entrant{.tracer = traversal::make_tracer(tracer.options),
                                              .arena = std::make_unique<tbb::task_arena>(threads),
                                              .built = {}});
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
    const anim::Scene scene = anim::load(plan.take.scene_file);
    const anim::Clip clip = choose_clip(scene, plan.take);
    const std::vector<Frame> frames = choose_frames(plan.take, clip, FramePattern("none.####.exr"));
    check_camera(scene, clip, plan.render.camera);

    engine::WaveTracer waves(scene, clip, plan.render);
    SceneBenchmark result{.scene = plan.take.scene_file.stem().string(),
                          .frames = frames.size(),
                          .phase = plan.phase,
                          .competitors = {},
                          .notes = waves.notes()};
    std::vector<Entrant> entrants = enter(plan, result.competitors);

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
                entrant.built = waves.rebuild(*entrant.tracer);
            }
            run.rebuild = entrant.built;
            if (plan.phase != BenchmarkPhase::rebuild) run.waves = waves.trace(*entrant.tracer, plan.bounce);
            return run;
        };
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
