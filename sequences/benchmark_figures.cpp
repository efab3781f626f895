#include "sequences/benchmark_figures.h"

#include "sequences/timing_table.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string_view>
#include <utility>

namespace gridreel::sequences {
namespace {

using engine::TraceCost;

constexpr std::array compared_phases{"rebuild", "primary", "shadow", "bounce", "frame"};

double nearest_rank(std::vector<double> values, double share) {
    std::sort(values.begin(), values.end());
    const auto rank = static_cast<std::size_t>(std::ceil(share * double(values.size())));
    return values[std::max<std::size_t>(rank, 1) - 1];
}

PhaseFigures phase_of(std::string_view name, std::vector<double> ms) {
    const Spread spread = spread_of(ms);
    return {.name = std::string(name),
            .ms = ms,
            .median_ms = spread.median,
            .min_ms = spread.min,
            .p95_ms = nearest_rank(std::move(ms), 0.95),
            .way = {}};
}

/// @param value  of a run
template <class Value>
PhaseFigures timed_phase(std::string_view name, const Competitor& competitor, const Value& value) {
    std::vector<double> ms;
    for (const BenchmarkRun& run : competitor.runs) ms.push_back(value(run));
    return phase_of(name, std::move(ms));
}

/// @param cost  of a run
template <class Cost>
PhaseFigures ray_phase(std::string_view name, const Competitor& competitor, std::size_t triangles,
                       const Cost& cost) {
    PhaseFigures figures =
        timed_phase(name, competitor, [&](const BenchmarkRun& run) { return cost(run).ms; });
    std::vector<double> rates;
    traversal::TraceReport all;
    for (const BenchmarkRun& run : competitor.runs) {
        const TraceCost& wave = cost(run);
        all += wave.report;
        rates.push_back(wave.ms > 0.0 ? double(wave.report.rays) / wave.ms * 1e3 : 0.0);
    }
    figures.rays_per_second = spread_of(std::move(rates)).median;
    if (all.rays > 0) {
        figures.cells_per_ray = double(all.cells) / double(all.rays);
        figures.tests_per_ray = double(all.triangle_tests) / double(all.rays);
    }
    if (triangles > 0) figures.extra_bytes_per_triangle = double(all.extra_bytes) / double(triangles);
    return figures;
}

/// @param costs  of a run, one per way
template <class Costs>
PhaseFigures quickest_way(std::string_view name, const Competitor& competitor, std::size_t triangles,
                          const Costs& costs) {
    PhaseFigures best;
    for (std::size_t way = 0; way < competitor.ways.size(); ++way) {
        PhaseFigures figures =
            ray_phase(name, competitor, triangles,
                      [&](const BenchmarkRun& run) -> const TraceCost& { return costs(run)[way]; });
        if (competitor.ways.size() > 1) figures.way = competitor.ways[way];
        if (way == 0 || figures.median_ms < best.median_ms) best = std::move(figures);
    }
    return best;
}

CompetitorFigures competitor_figures(const Competitor& competitor, const SceneBenchmark& benchmark) {
    assert(!competitor.runs.empty());
    CompetitorFigures figures{.name = competitor.name, .threads = competitor.threads, .phases = {}};
    auto& phases = figures.phases;
    const std::size_t triangles = benchmark.moving_triangles + benchmark.still_triangles;
    const bool rebuilt = benchmark.phase != BenchmarkPhase::trace;
    const bool traced = benchmark.phase != BenchmarkPhase::rebuild;

    // What was measured.
    if (rebuilt) {
        phases.push_back(timed_phase("animate", competitor, [](const auto& run) { return run.animate_ms; }));
        phases.push_back(
            timed_phase("rebuild", competitor, [](const auto& run) { return run.rebuild.total_ms; }));
    }
    if (traced) {
        phases.push_back(
            ray_phase("primary", competitor, triangles,
                      [](const BenchmarkRun& run) -> const TraceCost& { return run.waves.primary; }));
        phases.push_back(quickest_way(
            "shadow", competitor, triangles,
            [](const BenchmarkRun& run) -> auto& { return run.waves.shadow; }));
        if (!competitor.runs.front().waves.bounce.empty()) {
            phases.push_back(quickest_way(
                "bounce", competitor, triangles,
                [](const BenchmarkRun& run) -> auto& { return run.waves.bounce; }));
        }
        phases.push_back(
            timed_phase("making", competitor, [](const auto& run) { return run.waves.making_ms; }));
    }
    if (rebuilt && traced) {
        const PhaseFigures& rebuild = *figures.phase("rebuild");
        const PhaseFigures& primary = *figures.phase("primary");
        const PhaseFigures& shadow = *figures.phase("shadow");
        std::vector<double> ms(competitor.runs.size());
        for (std::size_t i = 0; i < ms.size(); ++i) ms[i] = rebuild.ms[i] + primary.ms[i] + shadow.ms[i];
        const double together = rebuild.median_ms + primary.median_ms + shadow.median_ms;
        figures.rebuild_share = together > 0.0 ? rebuild.median_ms / together : 0.0;
        phases.push_back(phase_of("frame", std::move(ms)));
    }

    // The structure.
    const rebuild::BuildReport& built = competitor.runs.back().rebuild;
    figures.bytes_per_triangle = triangles > 0 ? double(built.bytes) / double(triangles) : 0.0;
    figures.lambda = built.lambda;
    figures.resolution = built.resolution;
    figures.cells = built.cells;
    figures.references = built.references;
    return figures;
}

/// Phases of no time, such as shadows where nothing is lit, have no ratio.
void compare(const std::string& scene, const CompetitorFigures& ours, const CompetitorFigures& theirs,
             std::vector<Ratio>& ratios) {
    for (const std::string_view phase : compared_phases) {
        const PhaseFigures* const mine = ours.phase(phase);
        const PhaseFigures* const other = theirs.phase(phase);
        if (!mine || !other || mine->median_ms <= 0.0 || other->median_ms <= 0.0) continue;
        ratios.push_back({.scene = scene,
                          .phase = std::string(phase),
                          .against = theirs.name,
                          .threads = ours.threads,
                          .speedup = other->median_ms / mine->median_ms,
                          .ours_ms = mine->median_ms,
                          .theirs_ms = other->median_ms});
    }
}

}  // namespace

const PhaseFigures* CompetitorFigures::phase(std::string_view phase_name) const {
    const auto found = std::find_if(phases.begin(), phases.end(),
                                    [&](const PhaseFigures& phase) { return phase.name == phase_name; });
    return found == phases.end() ? nullptr : &*found;
}

SceneFigures figures_of(const SceneBenchmark& benchmark) {
    SceneFigures figures{.scene = benchmark.scene,
                         .frames = benchmark.frames,
                         .moving_triangles = benchmark.moving_triangles,
                         .still_triangles = benchmark.still_triangles,
                         .competitors = {},
                         .ratios = {}};
    for (const Competitor& competitor : benchmark.competitors) {
        figures.runs = competitor.runs.size();
        figures.competitors.push_back(competitor_figures(competitor, benchmark));
    }
    if (figures.competitors.empty()) return figures;

    const std::string& first = figures.competitors.front().name;
    for (const CompetitorFigures& ours : figures.competitors) {
        if (ours.name != first) continue;
        for (const CompetitorFigures& theirs : figures.competitors) {
            if (theirs.name == first || theirs.threads != ours.threads) continue;
            compare(benchmark.scene, ours, theirs, figures.ratios);
        }
    }
    return figures;
}

}  // namespace gridreel::sequences
