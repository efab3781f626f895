#pragma once
// The limit on threads of commands without --threads.

#include "sequences/thread_count.h"

#include <tbb/global_control.h>

#include <cstddef>

namespace gridreel::tools {

/// While it lives, parallel work uses no more threads than the process may keep busy: oneTBB looks at the
/// affinity mask alone, not at the quota of the control group. Of several limits oneTBB obeys the lowest, so
/// a command that takes --threads sets its own instead.
class AllowedParallelism {
private:
    tbb::global_control limit_{tbb::global_control::max_allowed_parallelism,
                               static_cast<std::size_t>(sequences::allowed_threads())};
};

}  // namespace gridreel::tools
