#pragma once
// The table at the end of a run.

#include "sequences/frame_record.h"

#include <span>
#include <string>
#include <vector>

namespace gridreel::sequences {

/// Smallest, middle and largest value of a list; the mean of the two middle ones when even.
struct Spread {
    double min = 0.0;
    double median = 0.0;
    double max = 0.0;
};

/// @param values  at least one
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// Part of a frame's ray tracing that went into rebuilding: rebuild / (rebuild + trace), 0 when both are 0.
[[nodiscard]] double rebuild_share(const FrameRecord& record);

/// Minimum, median and maximum milliseconds of each phase, of the rebuild share in percent, and of λ where it
/// was chosen by cost, over the frames that did not fail. One line per row, the last one ended too; empty
/// without such frames.
[[nodiscard]] std::string timing_table(std::span<const FrameRecord> records);

}  // namespace gridreel::sequences
