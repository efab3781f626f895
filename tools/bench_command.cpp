#include "sequences/benchmark.h"
#include "sequences/benchmark_figures.h"
#include "sequences/benchmark_json.h"
#include "sequences/benchmark_table.h"
#include "sequences/build_info.h"
#include "sequences/errors.h"
#include "sequences/render_text.h"
#include "sequences/thread_count.h"
#include "sequences/whole_file.h"
#include "tools/command.h"
#include "tools/competitors.h"
#include "tools/picture_options.h"
#include "traversal/simd_target.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gridreel::tools {
namespace {

using sequences::BenchmarkPhase;
using sequences::BenchmarkPlan;
using sequences::SceneFigures;
using sequences::UsageError;

/// Options as written.
struct BenchText {
    std::vector<std::string> scene_files;
    TakeText take;
    PictureText picture{.size = "1024x1024", .samples = 1};
    CompetitorText competitors;
    std::vector<int> threads;
    int repeat = 5;
    int warmup = 1;
    std::string phase = "all";
    bool bounce = false;
    std::string json, markdown;
    std::string baseline, fail_if;
};

void add_measure_options(CLI::App& app, BenchText& text) {
    const char* const group = "What to measure";
    app.add_option("-j,--threads", text.threads, "Numbers of threads")
        ->check(CLI::Range(1, 4096).description(""))
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("LIST")
        ->default_str("all allowed")
        ->group(group);
    app.add_option("--phase", text.phase,
                   "all: rebuild, then camera and shadow rays against opaque surfaces, without shading; or "
                   "only one of the two")
        ->check(CLI::IsMember({"all", "rebuild", "trace"}).description(""))
        ->type_name("all|rebuild|trace")
        ->capture_default_str()
        ->group(group);
    app.add_flag("--bounce", text.bounce, "Trace a diffuse bounce from every visible point, too")
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

void add_report_options(CLI::App& app, BenchText& text) {
    const char* const group = "Report";
    app.add_option("--json", text.json, "Figures in Google Benchmark's shape, all times and ratios")
        ->type_name("FILE")
        ->group(group);
    app.add_option("--markdown", text.markdown, "Table of ratios, a row for each scene")
        ->type_name("FILE")
        ->group(group);
    app.add_option("--baseline", text.baseline, "Figures of an earlier run (--json) to compare with")
        ->type_name("FILE")
        ->group(group);
    app.add_option("--fail-if", text.fail_if, "Exit 1 if a phase became slower by more than this")
        ->type_name("PERCENT")
        ->default_str("only report, beyond 10%")
        ->group(group);
}

/// `10%`, `10` or `2.5%`, as a share.
double parse_percent(const std::string& text) {
    const std::string number = text.ends_with('%') ? text.substr(0, text.size() - 1) : text;
    double percent = -1.0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), percent);
    if (error != std::errc{} || end != number.data() + number.size() || !(percent >= 0.0 && percent <= 1e6)) {
        throw UsageError(fmt::format("'{}' is not a percentage", text), "--fail-if", "write 10%");
    }
    return percent / 100.0;
}

/// The plan of every scene.
std::vector<BenchmarkPlan> read_plans(const BenchText& text) {
    BenchmarkPlan plan;
    plan.render = read_picture(text.picture);
    plan.tracers = read_competitors(text.competitors, plan.render.tracer);
    plan.threads = text.threads;
    if (plan.threads.empty()) plan.threads.push_back(sequences::allowed_threads());
    plan.repeat = text.repeat;
    plan.warmup = text.warmup;
    if (text.phase == "rebuild") plan.phase = BenchmarkPhase::rebuild;
    if (text.phase == "trace") plan.phase = BenchmarkPhase::trace;
    if (text.bounce) plan.bounce = engine::Bounce::traced;

    std::vector<BenchmarkPlan> plans;
    std::set<std::string> names;
    TakeText take = text.take;
    for (const std::string& file : text.scene_files) {
        take.scene_file = file;
        plan.take = read_take(take);
        plans.push_back(plan);
        if (!names.insert(plan.take.scene_file.stem().string()).second) {
            throw UsageError("two scenes have the same name, and their figures would too", file,
                             "rename one of the files");
        }
    }
    if (plans.empty()) (void)read_take(take);  // says that no scene is given
    return plans;
}

/// What to compare with, if anything, and by how much a phase may be slower.
struct Limit {
    std::optional<sequences::Baseline> baseline;
    bool fails = false;
    double allowed = 0.1;
};

Limit read_limit(const BenchText& text) {
    Limit limit;
    if (!text.fail_if.empty()) {
        if (text.baseline.empty()) {
            throw UsageError("there is nothing to compare with", "--fail-if", "add --baseline OLD.json");
        }
        limit.fails = true;
        limit.allowed = parse_percent(text.fail_if);
    }
    if (!text.baseline.empty()) limit.baseline = sequences::read_baseline(text.baseline);
    return limit;
}

/// @return whether it is slower than allowed
bool report_regressions(const Limit& limit, std::span<const SceneFigures> scenes, Console& console) {
    const auto comparison = sequences::compare_with(*limit.baseline, scenes, limit.allowed);
    if (!comparison.unknown.empty()) {
        console.warning(fmt::format("not in the baseline: {}", fmt::join(comparison.unknown, ", ")));
    }
    for (const std::string& line : comparison.regressed) console.result(line + "\n");
    console.result(fmt::format("{} of {} phases slower than the baseline by more than {:g}%\n",
                               comparison.regressed.size(), comparison.compared, 100.0 * limit.allowed));
    if (comparison.compared == 0) {
        throw UsageError("the baseline has none of the phases measured", "--baseline",
                         "measure the same scenes, structures and threads");
    }
    return !comparison.regressed.empty();
}

void prepare_folder(const std::string& file) {
    if (!file.empty()) sequences::make_folder(std::filesystem::path(file).parent_path());
}

ExitCode bench(const BenchText& text, Console& console) {
    const std::vector<BenchmarkPlan> plans = read_plans(text);
    const Limit limit = read_limit(text);
    prepare_folder(text.json);
    prepare_folder(text.markdown);
    const std::vector<int>& threads = plans.front().threads;
    const tbb::global_control allowed(
        tbb::global_control::max_allowed_parallelism,
        static_cast<std::size_t>(*std::max_element(threads.begin(), threads.end())));
    console.note(fmt::format("{}, {} kernels, {} run{} of each frame", sequences::cpu_name(),
                             traversal::simd_target(), plans.front().repeat,
                             plans.front().repeat == 1 ? "" : "s"));

    // A scene that fails does not take the others with it.
    std::vector<SceneFigures> scenes;
    bool scene_failed = false;
    for (const BenchmarkPlan& plan : plans) {
        try {
            const auto benchmark = sequences::run_benchmark(plan, [&](std::size_t done, std::size_t count) {
                console.line(
                    fmt::format("{}: {}/{} frames", plan.take.scene_file.stem().string(), done, count));
            });
            for (const std::string& note : benchmark.notes) console.note(note);
            scenes.push_back(sequences::figures_of(benchmark));
            console.result(sequences::benchmark_table(scenes.back()) + "\n");
        } catch (const UsageError&) {
            throw;
        } catch (const Error& error) {
            if (plans.size() == 1) throw;
            console.error(error.what());
            scene_failed = true;
        }
    }

    if (!text.json.empty()) {
        sequences::write_whole_file(text.json, sequences::benchmark_json(scenes, traversal::simd_target()));
    }
    if (!text.markdown.empty()) sequences::write_whole_file(text.markdown, sequences::markdown_table(scenes));
    const bool slower = limit.baseline && report_regressions(limit, scenes, console);
    if (scene_failed) return ExitCode::scene;
    return slower && limit.fails ? ExitCode::different : ExitCode::done;
}

}  // namespace

Command add_bench_command(CLI::App& program) {
    CLI::App* const app = program.add_subcommand(
        "bench", "Measure rebuild and trace, structures side by side; writes no images");
    const auto text = std::make_shared<BenchText>();
    app->add_option("SCENE", text->scene_files, "Scenes: .glb or .gltf")->type_name("");
    add_clip_options(*app, text->take, FrameOption::offered);
    add_variant_option(*app, text->take);
    add_competitor_options(*app, text->competitors);
    add_measure_options(*app, *text);
    add_report_options(*app, *text);
    add_picture_options(*app, text->picture);
    add_max_cells_option(*app, text->picture);
    return {.app = app,
            .run = [text](const CommonOptions&, Console& console) { return bench(*text, console); }};
}

}  // namespace gridreel::tools
