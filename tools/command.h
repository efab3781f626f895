#pragma once
// What the commands of `gridreel` have in common.

#include "sequences/take.h"
#include "tools/console.h"
#include "tools/exit_code.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace gridreel::tools {

/// Options that every command takes, also before the command's name.
struct CommonOptions {
    ConsoleOptions console;
    std::string config;  ///< job file; empty: none
};

/// A command of the program: its options are read into storage of its own, then it runs.
struct Command {
    CLI::App* app = nullptr;
    std::function<ExitCode(const CommonOptions&, Console&)> run;
};

[[nodiscard]] Command add_render_command(CLI::App& program);
[[nodiscard]] Command add_info_command(CLI::App& program);
[[nodiscard]] Command add_bake_command(CLI::App& program);
[[nodiscard]] Command add_bench_command(CLI::App& program);

/// -q -v --color --config --version.
void add_common_options(CLI::App& app, CommonOptions& options);

/// Makes an empty value of any option a mistake: `-f "$FRAMES"` with FRAMES unset must not mean the default.
/// Call it when all options are there.
void refuse_empty_values(CLI::App& app);

/// The text of the options that choose what is played.
struct TakeText {
    std::string scene_file;
    std::string asset_root;
    std::string frames;
    std::string fps = "24";
    std::string animation = "auto";
    std::string scene;
    std::string variant;
    bool loop = false;
};

enum class FrameOption { offered, left_out };

/// -f --loop --fps --animation --scene --asset-root.
void add_clip_options(CLI::App& app, TakeText& text, FrameOption frames);

/// SCENE, and those of `add_clip_options`.
void add_take_options(CLI::App& app, TakeText& text, FrameOption frames);

/// --variant, for commands to which materials matter.
void add_variant_option(CLI::App& app, TakeText& text);

/// @throws sequences::UsageError
[[nodiscard]] sequences::Take read_take(const TakeText& text);

/// Gives the options of `app` that the command line leaves open the values of a job file: keys of the
/// section named like the command, and those before any section. A key is an option's long name;
/// `input` is the SCENE file; it and `asset-root` are found beside the job file. Whatever is written goes
/// where it would without the file: relative to the current folder.
///
/// @throws sequences::UsageError for unknown keys and values that do not fit, with file and line
void apply_job_file(const std::filesystem::path& file, CLI::App& app);

}  // namespace gridreel::tools
