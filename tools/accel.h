#pragma once
// The values of --accel.

#include "traversal/tracer.h"

#include <string>
#include <string_view>

namespace gridreel::tools {

/// Those built in, for the help: "grid, grid-single, naive".
[[nodiscard]] std::string accel_names();

/// @throws sequences::UsageError for a name that no tracer has, or one that is not built in
[[nodiscard]] traversal::TracerKind read_accel(std::string_view name);

}  // namespace gridreel::tools
