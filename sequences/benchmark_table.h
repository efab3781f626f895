#pragma once
// Benchmark figures for people.

#include "sequences/benchmark_figures.h"

#include <span>
#include <string>

namespace gridreel::sequences {

/// Median, smallest and 95th percentile of each phase, millions of rays a second, the structure's size, and
/// how many times faster the first tracer is than the others.
[[nodiscard]] std::string benchmark_table(const SceneFigures& figures);

/// A Markdown table: a row for each scene and number of threads, a column for each ratio.
[[nodiscard]] std::string markdown_table(std::span<const SceneFigures> scenes);

}  // namespace gridreel::sequences
