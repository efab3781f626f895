#include "sequences/errors.h"
#include "sequences/job_file.h"
#include "tools/command.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gridreel::tools {
namespace {

using sequences::UsageError;

constexpr std::string_view scene_key = "input";

/// What is read is found beside the job file.
bool names_what_is_read(std::string_view key) {
    return key == scene_key || key == "asset-root";
}

CLI::Option* find_option(CLI::App& app, const std::string& key) {
    if (key == scene_key) return app.get_option_no_throw("SCENE");
    CLI::Option* const option = app.get_option_no_throw("--" + key);
    const bool settable =
        option && option != app.get_help_ptr() && option != app.get_version_ptr() && key != "config";
    return settable ? option : nullptr;
}

/// Whether the command line sets an option, before the command's name or after it.
bool on_command_line(const CLI::App& app, const CLI::Option& option, const std::string& key) {
    if (option.count() > 0) return true;
    const CLI::Option* const before = app.get_parent()->get_option_no_throw("--" + key);
    return before && before->count() > 0;
}

bool is_command(const CLI::App& program, const std::string& section) {
    const auto commands =
        program.get_subcommands([&](const CLI::App* app) { return app->get_name() == section; });
    return !commands.empty();
}

}  // namespace

void apply_job_file(const std::filesystem::path& file, CLI::App& app) {
    for (const sequences::JobFileEntry& entry : sequences::read_job_file(file)) {
        const std::string where = fmt::format("{}:{}", file.string(), entry.line);
        if (!entry.section.empty() && entry.section != app.get_name()) {
            if (is_command(*app.get_parent(), entry.section)) continue;
            throw UsageError(fmt::format("[{}] is not a command", entry.section), where, "write [render]");
        }
        CLI::Option* const option = find_option(app, entry.key);
        if (!option) {
            throw UsageError(
                fmt::format("unknown key '{}'", entry.key), where,
                fmt::format("use long option names of 'gridreel {} --help', and input for the scene file",
                            app.get_name()));
        }
        if (on_command_line(app, *option, entry.key)) continue;  // the command line wins

        try {
            if (names_what_is_read(entry.key)) {
                for (const std::string& path : entry.values)
                    option->add_result((file.parent_path() / path).string());
            } else {
                option->add_result(fmt::format("{}", fmt::join(entry.values, ",")));
            }
            option->run_callback();
        } catch (const CLI::ParseError& error) {
            throw UsageError(error.what(), where);
        }
    }
}

}  // namespace gridreel::tools
