#pragma once
// What benchmark runs come down to: medians by phase, and who is how many times faster.

#include "sequences/benchmark.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gridreel::sequences {

/// One phase of one competitor, over all runs. Milliseconds of wall clock.
struct PhaseFigures {
    std::string name;        ///< as in `figures_of`
    std::vector<double> ms;  ///< run by run
    double median_ms = 0.0, min_ms = 0.0;
    double p95_ms = 0.0;           ///< 95 of 100 runs are as quick (nearest rank)
    double rays_per_second = 0.0;  ///< median; 0 for phases without rays
    double cells_per_ray = 0.0;  ///< mean of all runs, as `traversal::TraceReport` counts: of packets, shared
    double tests_per_ray = 0.0;  ///< ray-triangle intersections; both 0 where nothing is counted
    double extra_bytes_per_triangle = 0.0;  ///< `traversal::TraceReport::extra_bytes`
    std::string way;                        ///< in which rays were traced, where there was a choice
};

struct CompetitorFigures {
    std::string name;
    int threads = 1;
    std::vector<PhaseFigures> phases;
    double rebuild_share = 0.0;       ///< rebuild / (rebuild + primary + shadow), of the medians
    double bytes_per_triangle = 0.0;  ///< structure and scratch, in the last run
    float lambda = 0.0f;              ///< of grids, in the last run
    glm::ivec3 resolution{0};         ///< in the last run
    std::uint64_t cells = 0, references = 0;

    [[nodiscard]] const PhaseFigures* phase(std::string_view phase_name) const;
};

/// How many times faster we are than somebody else in one phase.
struct Ratio {
    std::string scene, phase, against;
    int threads = 1;
    double speedup = 1.0;  ///< theirs_ms / ours_ms
    double ours_ms = 0.0, theirs_ms = 0.0;
};

struct SceneFigures {
    std::string scene;
    std::size_t frames = 0, runs = 0;  ///< runs of each competitor, over all frames
    std::size_t moving_triangles = 0, still_triangles = 0;
    std::vector<CompetitorFigures> competitors;
    std::vector<Ratio> ratios;
};

/// Phases, in this order, those that were measured: "animate", "rebuild", "primary", "shadow", "bounce",
/// "making" (of rays), "frame" (rebuild + primary + shadow). Rays that were traced in several ways count in
/// the quickest, by the median. Ratios set the first tracer against each other one on as many threads, in
/// all phases but "animate" and "making".
///
/// @param benchmark  with at least one run of every competitor
[[nodiscard]] SceneFigures figures_of(const SceneBenchmark& benchmark);

}  // namespace gridreel::sequences
