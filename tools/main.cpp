// The `gridreel` command: reads the command line, runs a command, and turns what goes wrong into an exit
// code.

#include "sequences/errors.h"
#include "tools/command.h"
#include "traversal/simd_target.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

namespace {

using namespace gridreel;
using namespace gridreel::tools;

constexpr std::string_view out_of_memory =
    "out of memory; render at a smaller --size or on fewer threads, or simplify the scene: gridreel info "
    "says "
    "how much it takes";

std::string defect_text(const std::exception& error) {
    return fmt::format("a defect in gridreel: {}", error.what());
}

/// Runs `work`; every exception of the program ends here.
template <class Work>
ExitCode with_exit_code(const ConsoleOptions& options, Work work) {
    Console console(options);
    const auto fail = [&](std::string_view text, ExitCode code) {
        console.error(text);
        return code;
    };
    try {
        return work(console);
    } catch (const sequences::UsageError& error) {
        return fail(error.what(), ExitCode::usage);
    } catch (const sequences::OutputError& error) {
        return fail(error.what(), ExitCode::output);
    } catch (const Error& error) {
        return fail(error.what(), ExitCode::scene);
    } catch (const std::bad_alloc&) {
        return fail(out_of_memory, ExitCode::defect);
    } catch (const std::system_error& error) {
        // Threads that cannot start, in most cases for want of memory for their stacks.
        const bool exhausted = error.code() == std::errc::resource_unavailable_try_again ||
                               error.code() == std::errc::not_enough_memory;
        return fail(exhausted ? std::string(out_of_memory) : defect_text(error), ExitCode::defect);
    } catch (const std::exception& error) {
        return fail(defect_text(error), ExitCode::defect);
    }
}

/// GRIDREEL_TARGET caps the instruction set of the kernels: to compare them, or to reproduce another
/// machine's pixels.
void obey_target_limit() {
    const char* const wanted =
        std::getenv("GRIDREEL_TARGET");  // NOLINT(concurrency-mt-unsafe): no thread yet
    if (wanted == nullptr || traversal::limit_simd_target(wanted)) return;
    throw sequences::UsageError(fmt::format("no kernels for '{}' on this machine", wanted), "GRIDREEL_TARGET",
                                fmt::format("choose from {}", fmt::join(traversal::simd_targets(), ", ")));
}

ExitCode run(int argc, char** argv) {
    CLI::App program("Renders animated glTF to image sequences, rebuilding its grid every frame.",
                     "gridreel");
    program.get_formatter()->column_width(34);
    program.require_subcommand(1);
    CommonOptions options;
    add_common_options(program, options);
    const std::array commands{add_render_command(program), add_info_command(program),
                              add_bake_command(program), add_bench_command(program)};
    refuse_empty_values(program);
    for (const Command& command : commands) {
        add_common_options(*command.app, options);
        refuse_empty_values(*command.app);
    }

    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        return static_cast<ExitCode>(program.exit(help_or_version));
    } catch (const CLI::ParseError& error) {
        Console(options.console).error(fmt::format("{}; see gridreel --help", error.what()));
        return ExitCode::usage;
    }

    for (const Command& command : commands) {
        if (!program.got_subcommand(command.app)) continue;
        // The job file may ask for colours and quiet, so it comes before the console that reports the rest.
        const ExitCode configured = with_exit_code(options.console, [&](Console&) {
            obey_target_limit();
            if (!options.config.empty()) apply_job_file(options.config, *command.app);
            return ExitCode::done;
        });
        if (configured != ExitCode::done) return configured;
        return with_exit_code(options.console,
                              [&](Console& console) { return command.run(options, console); });
    }
    return ExitCode::usage;
}

}  // namespace

int main(int argc, char** argv) {
    return static_cast<int>(run(argc, argv));
}
