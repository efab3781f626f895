#pragma once
// Ctrl-C asks; asked twice, it insists.

#include <atomic>

namespace gridreel::tools {

/// Makes SIGINT and SIGTERM set the flag that is returned. A second one ends the process at once.
/// Programs that were started with the signal ignored keep ignoring it.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace gridreel::tools
