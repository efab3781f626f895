#pragma once
// Benchmark figures as JSON, and the comparison with those of an earlier run.

#include "sequences/benchmark_figures.h"

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gridreel::sequences {

/// The shape of Google Benchmark's JSON: `context`, and `benchmarks` with one aggregate (the median) for each
/// phase, named `SCENE/TRACER/threads:N/PHASE`. Beyond it: every run's milliseconds under `times`, and all
/// ratios under `ratios`. `cpu_time` repeats `real_time`, which alone is measured, for programs that ask.
///
/// @param instruction_set  of the kernels
[[nodiscard]] std::string benchmark_json(std::span<const SceneFigures> scenes,
                                         std::string_view instruction_set);

/// Median milliseconds by benchmark name, of an earlier run.
using Baseline = std::map<std::string, double>;

/// @throws UsageError when the file cannot be read, is not JSON, or not of the above shape
[[nodiscard]] Baseline read_baseline(const std::filesystem::path& file);

/// What the comparison with a baseline found.
struct BaselineComparison {
    std::size_t compared = 0;
    std::vector<std::string> regressed;  ///< a sentence for each phase that became slower than allowed
    std::vector<std::string> unknown;    ///< names that the baseline does not have
};

/// Holds every compared phase (as for ratios) against the baseline.
/// @param allowed  share by which a median may be slower: 0.1 is 10 %
[[nodiscard]] BaselineComparison compare_with(const Baseline& baseline, std::span<const SceneFigures> scenes,
                                              double allowed);

}  // namespace gridreel::sequences
