#include "anim/parse_number.h"
#include "sequences/build_info.h"
#include "sequences/errors.h"
#include "tools/command.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <map>

namespace gridreel::tools {
namespace {

using sequences::UsageError;

anim::Index parse_scene_number(const std::string& text) {
    if (const auto number = parse_number<anim::Index>(text)) return *number;
    throw UsageError(fmt::format("'{}' is not a scene's number", text), "--scene",
                     "give a number from 0, as gridreel info counts them");
}

}  // namespace

void add_common_options(CLI::App& app, CommonOptions& options) {
    // Again, so that it stands here rather than before a command's own options.
    app.set_help_flag();
    app.set_help_flag("-h,--help", "Print this")->group("General");
    const std::map<std::string, When> when{
        {"auto", When::automatic}, {"always", When::always}, {"never", When::never}};
    app.add_flag("-q,--quiet", options.console.quiet, "Errors only")->group("General");
    app.add_flag("-v,--verbose", options.console.verbose, "Say more")->group("General");
    app.add_option_function<std::string>(
           "--color", [&options, when](const std::string& text) { options.console.color = when.at(text); },
           "Coloured messages (NO_COLOR is obeyed)")
        ->check(CLI::IsMember({"auto", "always", "never"}).description(""))
        ->type_name("auto|always|never")
        ->default_str("auto")
        ->group("General");
    app.add_option("--config", options.config,
                   "Job file: TOML with the long option names, and input = \"SCENE\"")
        ->type_name("FILE")
        ->group("General");
    app.set_version_flag("--version", fmt::format("gridreel {}", sequences::version()), "Print the version")
        ->group("General");
}

void refuse_empty_values(CLI::App& app) {
    const CLI::Validator not_empty(
        [](const std::string& value) {
            return value.empty() ? std::string("the value is empty") : std::string();
        },
        "");
    for (CLI::Option* const option : app.get_options()) option->check(not_empty);
}

void add_clip_options(CLI::App& app, TakeText& text, FrameOption frames) {
    if (frames == FrameOption::offered) {
        app.add_option("-f,--frames", text.frames, "7, 1-240, 1-240x2, 1,5,10-20, -5--1, last")
            ->type_name("LIST")
            ->default_str("whole clip")
            ->group("What to play");
        app.add_flag("--loop", text.loop,
                     "Without --frames: leave the last frame out when it repeats the first")
            ->group("What to play");
    }
    app.add_option("--fps", text.fps, "Frames per second; 30000/1001 too")
        ->type_name("RATE")
        ->capture_default_str()
        ->group("What to play");
    app.add_option("--animation", text.animation,
                   "NAME, number, all, none, or auto: all when their targets are disjoint, else the first")
        ->type_name("CHOICE")
        ->capture_default_str()
        ->group("What to play");
    app.add_option("--scene", text.scene, "Number of the scene in the file")
        ->type_name("N")
        ->default_str("the file's default")
        ->group("What to play");
    app.add_option("--asset-root", text.asset_root,
                   "Images and buffers that the scene names may lie in DIR, too")
        ->type_name("DIR")
        ->default_str("the scene's folder alone")
        ->group("What to play");
}

void add_variant_option(CLI::App& app, TakeText& text) {
    app.add_option("--variant", text.variant, "NAME or number of a variant of the materials")
        ->type_name("CHOICE")
        ->default_str("the materials' own")
        ->group("What to play");
}

void add_take_options(CLI::App& app, TakeText& text, FrameOption frames) {
    app.add_option("SCENE", text.scene_file, "Scene: .glb or .gltf")->type_name("");
    add_clip_options(app, text, frames);
}

sequences::Take read_take(const TakeText& text) {
    if (text.scene_file.empty()) {
        throw UsageError("no scene is given", "SCENE", "name a .glb or .gltf file, or 'input' in a job file");
    }
    sequences::Take take;
    take.scene_file = text.scene_file;
    take.asset_root = text.asset_root;
    take.animation = text.animation;
    take.variant = text.variant;
    take.rate = sequences::parse_frame_rate(text.fps);
    take.loop = text.loop;
    if (!text.scene.empty()) take.scene = parse_scene_number(text.scene);
    if (!text.frames.empty()) take.frames = sequences::parse_frame_list(text.frames);
    return take;
}

}  // namespace gridreel::tools
