#pragma once
// How many threads this process may keep busy.

#include <optional>
#include <string_view>

namespace gridreel::sequences {

/// Processors in the affinity mask, fewer when the control groups' quota is less; at least 1.
[[nodiscard]] int allowed_threads();

/// Processors' worth of time in the text of a control group's `cpu.max` ("200000 100000" is 2), rounded up.
/// @return nothing when it is "max", no limit, or not understood
[[nodiscard]] std::optional<int> cpu_quota(std::string_view cpu_max);

}  // namespace gridreel::sequences
