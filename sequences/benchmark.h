#pragma once
// The same frames with several tracers and numbers of threads, side by side.

#include "engine/frame_renderer.h"
#include "sequences/take.h"
#include "traversal/tracer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gridreel::sequences {

/// What to compare, and how often to measure.
struct BenchmarkPlan {
    Take take;
    engine::RenderSettings render;  ///< but for the kind of tracer
    std::vector<traversal::TracerKind> tracers{traversal::TracerKind::grid};
    std::vector<int> threads{1};  ///< each >= 1
    int repeat = 5;               ///< >= 1: measured runs of every frame
    int warmup = 1;               ///< >= 0: runs of every frame before
};

/// One tracer on one number of threads, and everything measured of it.
struct Competitor {
    traversal::TracerKind tracer = traversal::TracerKind::grid;
    int threads = 1;
    std::vector<engine::FrameReport> runs;  ///< frames * repeat of them
};

/// Renders every frame with every competitor in turn, so that all of them see the same quiet and noisy
/// moments of the machine. No pictures are written, and no two frames overlap.
///
/// @param frame_done  called after each frame with how many are done, and of how many
/// @throws Error, UsageError as `run_job`
[[nodiscard]] std::vector<Competitor> run_benchmark(
    const BenchmarkPlan& plan, const std::function<void(std::size_t, std::size_t)>& frame_done);

/// Median milliseconds per phase and million rays a second of each competitor, a row each; then how many
/// times faster the first tracer is than the others on the same number of threads.
[[nodiscard]] std::string benchmark_table(std::span<const Competitor> competitors);

}  // namespace gridreel::sequences
