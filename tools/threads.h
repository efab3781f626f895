#pragma once
// How many threads a command works on.

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace CLI {
class App;
}

namespace gridreel::tools {

/// -j --threads.
/// @param threads  0 until the command line says more; `thread_count` makes a number of it
void add_threads_option(CLI::App& app, int& threads);

/// The number asked for, or for 0 as many as the process may keep busy.
[[nodiscard]] int thread_count(int asked_for);

/// Calls `work` where parallel work uses `threads` threads, more or fewer than the machine's processors.
/// oneTBB itself would look at the affinity mask alone, not at the quota of the control group.
template <class Work>
auto run_on_threads(int threads, const Work& work) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute(work);
}

}  // namespace gridreel::tools
