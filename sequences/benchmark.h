#pragma once
// The same frames through several tracers and numbers of threads, in turns.

#include "engine/render_settings.h"
#include "engine/wave_tracer.h"
#include "rebuild/build_report.h"
#include "sequences/take.h"
#include "traversal/tracer.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace gridreel::sequences {

/// What every run measures.
enum class BenchmarkPhase {
    all,      ///< rebuild and trace
    rebuild,  ///< rebuild only
    trace,    ///< trace only, through what each frame's first run has built
};

/// A tracer with its settings, under the name that tables give it.
struct NamedTracer {
    std::string name;  ///< "grid", "grid:0.5" (λ), "embree-refit"
    traversal::TracerOptions options;
};

/// What to compare, and how often to measure.
struct BenchmarkPlan {
    Take take;
    engine::RenderSettings render;     ///< but for the tracer
    std::vector<NamedTracer> tracers;  ///< the first is ours, the others it is compared with
    std::vector<int> threads{1};       ///< each >= 1
    int repeat = 5;                    ///< >= 1: measured runs of every frame
    int warmup = 1;                    ///< >= 0: runs of every frame before
    BenchmarkPhase phase = BenchmarkPhase::all;
    engine::Bounce bounce = engine::Bounce::left_out;
};

/// One measured run of one frame.
struct BenchmarkRun {
    double animate_ms = 0.0;
    rebuild::BuildReport rebuild;
    engine::WaveReport waves;
};

/// One tracer on one number of threads, and everything measured of it.
struct Competitor {
    std::string name;
    int threads = 1;
    std::vector<std::string> ways;   ///< as `traversal::Tracer::ways`
    std::vector<BenchmarkRun> runs;  ///< frames * repeat of them, frame by frame
};

/// What one scene gave.
struct SceneBenchmark {
    std::string scene;  ///< the file's name without its extension
    std::size_t frames = 0;
    std::size_t moving_triangles = 0, still_triangles = 0;
    BenchmarkPhase phase = BenchmarkPhase::all;
    std::vector<Competitor> competitors;
    std::vector<std::string> notes;  ///< what the renderer decided on its own
};

/// Measures every frame with every competitor in turn, so that all of them see the same quiet and noisy
/// moments of the machine; who begins changes from run to run. Every run poses the frame anew, so that each
/// finds the triangles as fresh in the caches as the others do. Structures are first built at the clip's
/// start: what is refitted later comes from there. Refitting looks at nothing but the tree, which stays, and
/// where its triangles are now: straight to a frame it ends where it does by way of all frames before it. A λ
/// that is chosen by cost settles in a few runs more of the first frame, unless there is no warm-up, and
/// keeps to what it learned there where not both phases are measured.
///
/// Work runs in arenas of as many threads as asked for: the process must be allowed that many.
///
/// @param frame_done  called after each frame with how many are done, and of how many
/// @throws Error, UsageError as `run_job`
[[nodiscard]] SceneBenchmark run_benchmark(const BenchmarkPlan& plan,
                                           const std::function<void(std::size_t, std::size_t)>& frame_done);

}  // namespace gridreel::sequences
