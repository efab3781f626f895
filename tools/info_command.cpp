#include "sequences/scene_info.h"
#include "tools/command.h"
#include "tools/threads.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <memory>

namespace gridreel::tools {
namespace {

struct InfoText {
    TakeText take;
    bool json = false;
};

}  // namespace

Command add_info_command(CLI::App& program) {
    CLI::App* const app =
        program.add_subcommand("info", "Say what is in a scene file; exit 3 when it cannot be rendered");
    const auto text = std::make_shared<InfoText>();
    add_take_options(*app, text->take, FrameOption::left_out);
    add_variant_option(*app, text->take);
    app->add_flag("--json", text->json, "One JSON object")->group("Output");
    return {.app = app, .run = [text](const CommonOptions&, Console& console) {
                const sequences::Take take = read_take(text->take);
                const sequences::SceneInfo info =
                    run_on_threads(thread_count(0), [&] { return sequences::inspect(take); });
                console.result(text->json ? sequences::to_json_text(info) : sequences::to_text(info));
                return ExitCode::done;
            }};
}

}  // namespace gridreel::tools
