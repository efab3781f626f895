#include "sequences/build_info.h"
#include "sequences/errors.h"
#include "sequences/render_text.h"
#include "sequences/run_job.h"
#include "sequences/timing_table.h"
#include "tools/accel.h"
#include "tools/command.h"
#include "tools/interrupt.h"
#include "tools/picture_options.h"
#include "tools/threads.h"
#include "traversal/simd_target.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace gridreel::tools {
namespace {

using sequences::Job;
using sequences::JobResult;
using sequences::UsageError;

/// Options as written; `read_job` makes sense of them.
struct RenderText {
    TakeText take;
    std::string output;
    PictureText picture;
    std::string aov;
    std::string depth = "half";
    std::string compression = "zip";
    bool keep_going = false;
    int threads = 0;
    std::string accel = "grid";
    std::string log;
    std::string progress = "auto";
};

void add_output_options(CLI::App& app, RenderText& text) {
    const char* const group = "Output";
    app.add_option("-o,--output", text.output, "Frames to write, .exr or .png; #### or %04d is the number")
        ->type_name("PATTERN")
        ->default_str("frames/SCENE.####.exr")
        ->group(group);
    app.add_option("--aov", text.aov, "Extra EXR channels: z (Z), n (N.X N.Y N.Z), all")
        ->type_name("LIST")
        ->default_str("none")
        ->group(group);
    app.add_option("--depth", text.depth, "EXR numbers; Z is always float")
        ->check(CLI::IsMember({"half", "float"}).description(""))
        ->type_name("half|float")
        ->capture_default_str()
        ->group(group);
    app.add_option("--compression", text.compression, "EXR, lossless: none, rle, zips, zip or piz")
        ->type_name("NAME")
        ->capture_default_str()
        ->group(group);
    app.add_option("--log", text.log, "One JSON object per frame, appended")
        ->type_name("FILE")
        ->default_str("the output's folder/SCENE.jsonl")
        ->group(group);
    app.add_option("--progress", text.progress, "Bar: on a terminal (auto), always, or neither bar nor lines")
        ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
        ->type_name("auto|always|never")
        ->capture_default_str()
        ->group(group);
    app.add_flag("--keep-going", text.keep_going, "Go on after a frame that failed; exit 5")->group(group);
}

void add_machine_options(CLI::App& app, RenderText& text) {
    add_threads_option(app, text.threads);
    app.add_option("--accel", text.accel, fmt::format("Acceleration structure: {}", accel_names()))
        ->type_name("NAME")
        ->capture_default_str()
        ->group("Machine");
}

Job read_job(const RenderText& text) {
    Job job;
    job.take = read_take(text.take);
    job.output = text.output.empty() ? sequences::default_output(job.take.scene_file, ".exr")
                                     : sequences::FramePattern(text.output);
    job.image.format = sequences::image_format(job.output.extension());
    job.image.depth = text.depth == "float" ? sequences::Depth::single_float : sequences::Depth::half_float;
    job.image.compression = text.compression;
    if (!text.aov.empty()) sequences::choose_aovs(text.aov, job.image);
    job.log = text.log.empty() ? sequences::default_log(job.output, job.take.scene_file)
                               : std::filesystem::path(text.log);
    job.render = read_picture(text.picture);
    job.render.tracer.kind = read_accel(text.accel);
    job.threads = thread_count(text.threads);
    job.keep_going = text.keep_going;
    return job;
}

void print_results(const Job& job, const JobResult& result, double elapsed_s, Console& console) {
    const std::size_t written = result.frames.size() - result.failed_frames();
    if (written == 0) return;
    console.result(sequences::timing_table(result.frames));
    console.result(fmt::format("{} frame{} in {:.2f} s ({:.2f} frames/s): {}\nlog: {}\n", written,
                               written == 1 ? "" : "s", elapsed_s, double(written) / elapsed_s,
                               job.output.text(), job.log.string()));
}

ExitCode render(const RenderText& text, Console& console) {
    const Job job = read_job(text);
    const When when = text.progress == "always"  ? When::always
                      : text.progress == "never" ? When::never
                                                 : When::automatic;
    console.detail(fmt::format("{}, {} kernels, {} threads, log {}", sequences::cpu_name(),
                               traversal::simd_target(), job.threads, job.log.string()));

    ProgressDisplay display(console, when, job.keep_going);
    const JobResult result =
        run_on_threads(job.threads, [&] { return sequences::run_job(job, display, watch_for_interrupt()); });
    console.end_bar();
    print_results(job, result, display.progress().elapsed_s, console);
    if (result.interrupted) {
        console.note(
            fmt::format("interrupted after {} of {} frames", result.frames.size(), display.progress().total));
        return ExitCode::interrupted;
    }
    if (const std::size_t failed = result.failed_frames(); failed > 0) {
        console.error(fmt::format("{} of {} frames failed; the log says why", failed, result.frames.size()));
        return ExitCode::some_failed;
    }
    return ExitCode::done;
}

}  // namespace

Command add_render_command(CLI::App& program) {
    CLI::App* const app =
        program.add_subcommand("render", "Render frames of an animated scene to image files");
    const auto text = std::make_shared<RenderText>();
    add_take_options(*app, text->take, FrameOption::offered);
    add_variant_option(*app, text->take);
    add_picture_options(*app, text->picture);
    add_output_options(*app, *text);
    add_machine_options(*app, *text);
    add_grid_options(*app, text->picture);
    // Scripts put their own before the user's: the later one wins.
    for (const char* const name : {"--frames", "--size"}) {
        app->get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    }
    return {.app = app,
            .run = [text](const CommonOptions&, Console& console) { return render(*text, console); }};
}

}  // namespace gridreel::tools
