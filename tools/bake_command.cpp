#include "sequences/bake.h"
#include "sequences/job.h"
#include "sequences/render_text.h"
#include "tools/command.h"
#include "tools/interrupt.h"
#include "tools/threads.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>

namespace gridreel::tools {
namespace {

struct BakeText {
    TakeText take;
    std::string output;
    bool normals = false;
    std::string camera = "auto";
    std::string size = "1280x720";
    int threads = 0;
};

sequences::BakeJob read_job(const BakeText& text) {
    sequences::BakeJob job;
    job.take = read_take(text.take);
    const sequences::PictureSize size = sequences::parse_size(text.size);
    job.output = text.output.empty() ? sequences::default_output(job.take.scene_file, ".ply")
                                     : sequences::FramePattern(text.output);
    job.normals = text.normals;
    job.camera = text.camera;
    job.width = size.width;
    job.height = size.height;
    return job;
}

ExitCode bake(const BakeText& text, Console& console) {
    const sequences::BakeJob job = read_job(text);
    const sequences::BakeReports reports{
        .warning = [&](std::string_view warning) { console.warning(warning); },
        .note = [&](std::string_view note) { console.note(note); },
        .frame_done =
            [&](sequences::Frame frame, const std::filesystem::path& file, std::size_t done,
                std::size_t total) {
                console.line(fmt::format("{}/{} frame {} -> {}", done, total, frame, file.string()));
            }};
    const sequences::BakeResult result = run_on_threads(
        thread_count(text.threads), [&] { return sequences::bake(job, reports, watch_for_interrupt()); });
    console.result(fmt::format("{} frame{}: {}\ncameras: {}\n", result.frames, result.frames == 1 ? "" : "s",
                               job.output.text(), result.cameras.string()));
    return result.interrupted ? ExitCode::interrupted : ExitCode::done;
}

}  // namespace

Command add_bake_command(CLI::App& program) {
    CLI::App* const app =
        program.add_subcommand("bake", "Write the deformed triangles of frames to PLY files");
    const auto text = std::make_shared<BakeText>();
    add_take_options(*app, text->take, FrameOption::offered);
    app->add_option("-o,--output", text->output, "Files to write, .ply; #### or %04d is the number")
        ->type_name("PATTERN")
        ->default_str("frames/SCENE.####.ply")
        ->group("Output");
    app->add_flag("--normals", text->normals, "Vertex normals too")->group("Output");
    app->add_option("--camera", text->camera, "Of SCENE.cameras.json; as for render")
        ->type_name("CHOICE")
        ->capture_default_str()
        ->group("Output");
    app->add_option("-s,--size", text->size, "Picture that the camera is for, pixels; as for render")
        ->type_name("WxH")
        ->capture_default_str()
        ->group("Output");
    add_threads_option(*app, text->threads);
    return {.app = app,
            .run = [text](const CommonOptions&, Console& console) { return bake(*text, console); }};
}

}  // namespace gridreel::tools
