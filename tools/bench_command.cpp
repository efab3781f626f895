#include "sequences/benchmark.h"
#include "sequences/build_info.h"
#include "sequences/errors.h"
#include "sequences/thread_count.h"
#include "tools/command.h"
#include "tools/picture_options.h"
#include "traversal/simd_target.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace gridreel::tools {
namespace {

/// Options as written.
struct BenchText {
    TakeText take;
    PictureText picture{.size = "1024x1024", .samples = 1};
    std::vector<std::string> accels{"grid"};
    std::vector<int> threads;
    int repeat = 5;
    int warmup = 1;
};

void add_bench_options(CLI::App& app, BenchText& text) {
    const char* const group = "Benchmark";
    std::vector<std::string> accels;
    for (const auto kind : traversal::tracer_kinds()) accels.emplace_back(traversal::name_of(kind));
    app.add_option("--accel", text.accels, fmt::format("Structures to compare: {}", fmt::join(accels, ", ")))
        ->check(CLI::IsMember(accels).description(""))
        ->delimiter(',')
        ->type_name("LIST")
        ->default_str("grid")
        ->group(group);
    app.add_option("-j,--threads", text.threads, "Numbers of threads to compare")
        ->check(CLI::Range(1, 4096).description(""))
        ->delimiter(',')
        ->type_name("LIST")
        ->default_str("all allowed")
        ->group(group);
    app.add_option("--repeat", text.repeat, "Measured runs of every frame")
        ->check(CLI::Range(1, 10'000).description(""))
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
    app.add_option("--warmup", text.warmup, "Runs of every frame before they count")
        ->check(CLI::Range(0, 10'000).description(""))
        ->type_name("N")
        ->capture_default_str()
        ->group(group);
}

sequences::BenchmarkPlan read_plan(const BenchText& text) {
    sequences::BenchmarkPlan plan;
    plan.take = read_take(text.take);
    plan.render = read_picture(text.picture);
    plan.repeat = text.repeat;
    plan.warmup = text.warmup;
    plan.tracers.clear();
    for (const std::string& name : text.accels) plan.tracers.push_back(traversal::tracer_kind(name).value());
    plan.threads = text.threads;
    if (plan.threads.empty()) plan.threads.push_back(sequences::allowed_threads());
    return plan;
}

ExitCode bench(const BenchText& text, Console& console) {
    const sequences::BenchmarkPlan plan = read_plan(text);
    const int most = *std::max_element(plan.threads.begin(), plan.threads.end());
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(most));
    console.note(fmt::format("{}, {} kernels, {} run{} of each frame", sequences::cpu_name(),
                             traversal::simd_target(), plan.repeat, plan.repeat == 1 ? "" : "s"));
    const auto competitors = sequences::run_benchmark(plan, [&](std::size_t done, std::size_t count) {
        console.line(fmt::format("{}/{} frames", done, count));
    });
    console.result(sequences::benchmark_table(competitors));
    return ExitCode::done;
}

}  // namespace

Command add_bench_command(CLI::App& program) {
    CLI::App* const app = program.add_subcommand(
        "bench", "Measure rebuild and trace, structures side by side; writes no images");
    const auto text = std::make_shared<BenchText>();
    add_take_options(*app, text->take, FrameOption::offered);
    add_bench_options(*app, *text);
    add_picture_options(*app, text->picture);
    add_grid_options(*app, text->picture);
    return {.app = app,
            .run = [text](const CommonOptions&, Console& console) { return bench(*text, console); }};
}

}  // namespace gridreel::tools
