#pragma once
// What `gridreel` returns to the shell.

namespace gridreel::tools {

enum class ExitCode : int {
    done = 0,
    different = 1,      ///< images differ, or a benchmark regressed
    usage = 2,          ///< wrong usage, or would mix jobs
    scene = 3,          ///< unreadable, invalid or needs an unsupported extension
    output = 4,         ///< cannot write output
    some_failed = 5,    ///< some frames failed (--keep-going)
    defect = 70,        ///< a mistake in gridreel itself, or no memory left (EX_SOFTWARE of sysexits)
    interrupted = 130,  ///< SIGINT or SIGTERM
};

}  // namespace gridreel::tools
