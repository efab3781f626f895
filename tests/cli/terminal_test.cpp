#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace gridreel::test;

namespace {

Outcome render(const std::vector<std::string>& more, bool terminal) {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    std::vector<std::string> arguments{"render", "tiny.gltf", "-s", "16x8", "-f", "0-2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_gridreel(arguments, {.folder = folder.path(), .terminal = terminal});
}

bool has_bar(const std::string& text) {
    return text.find("\r\x1b[K[") != std::string::npos && text.find("frames/s") != std::string::npos;
}

bool has_lines(const std::string& text) {
    return text.find("3/3 frame 2 -> ") != std::string::npos;
}

}  // namespace

TEST_CASE("a terminal gets a bar, a file gets lines", "[cli][terminal]") {
    const Outcome on_terminal = render({}, true);
    CHECK(on_terminal.exit_code == 0);
    CHECK(has_bar(on_terminal.err));
    CHECK_FALSE(has_lines(on_terminal.err));
    CHECK(on_terminal.err.find("3/3") != std::string::npos);
    CHECK(on_terminal.err.ends_with("\n"));
    CHECK(on_terminal.out.find('\r') == std::string::npos);

    const Outcome in_file = render({}, false);
    CHECK_FALSE(has_bar(in_file.err));
    CHECK(has_lines(in_file.err));
}

TEST_CASE("the bar can be forced or forbidden", "[cli][terminal]") {
    CHECK(has_bar(render({"--progress", "always"}, false).err));
    const Outcome never = render({"--progress", "never"}, true);
    CHECK_FALSE(has_bar(never.err));
    CHECK_FALSE(has_lines(never.err));
}

TEST_CASE("messages are coloured on a terminal unless forbidden", "[cli][terminal]") {
    const auto error = [](std::vector<std::string> more, bool terminal) {
        more.insert(more.begin(), {"info", "missing.glb"});
        return run_gridreel(more, {.folder = "/", .terminal = terminal}).err;
    };
    CHECK(error({}, true).find("\x1b[31m") != std::string::npos);
    CHECK(error({"--color", "never"}, true).find('\x1b') == std::string::npos);
    CHECK(error({}, false).find('\x1b') == std::string::npos);
    const Setting plain{.folder = "/", .variables = {"NO_COLOR=1"}, .terminal = true};
    CHECK(run_gridreel({"info", "missing.glb"}, plain).err.find('\x1b') == std::string::npos);
    CHECK(error({"--color", "always"}, false).find("\x1b[31m") != std::string::npos);
}
