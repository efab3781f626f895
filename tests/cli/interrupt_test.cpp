#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

using namespace gridreel::test;

namespace {

/// Waits until the file has some lines, at most 20 s.
void wait_for_lines(const std::filesystem::path& file, long lines) {
    for (int i = 0; i < 4000; ++i) {
        const std::string text = bytes_of(file);
        if (std::count(text.begin(), text.end(), '\n') >= lines) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace

TEST_CASE("Ctrl-C closes the log, leaves whole frames only, and is exit 130", "[cli][interrupt]") {
    for (const int signal : {SIGINT, SIGTERM}) {
        const ScratchFolder folder;
        write_tiny_scene(folder.path());
        const auto interrupt = [&](int process) {
            wait_for_lines(folder / "out/t.jsonl", 4);
            kill(process, signal);
        };
        const Outcome outcome =
            run_gridreel({"render", "tiny.gltf", "-s", "64x32", "-f", "0-99999", "-o", "out/t.#####.exr"},
                         {.folder = folder.path(), .meanwhile = interrupt});
        CHECK(outcome.exit_code == 130);
        CHECK(outcome.err.find("interrupted") != std::string::npos);

        // Every line of the log is whole and has its file; every file has its line.
        const auto frames = frames_of(folder / "out/t.jsonl");
        CHECK(frames.size() >= 3);
        CHECK(frames.size() < 99999);
        for (const auto& frame : frames) CHECK(std::filesystem::file_size(folder / frame["file"]) > 0);
        std::size_t files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
            files += entry.path().extension() == ".exr";
            CHECK(entry.path().extension() != ".part");
        }
        CHECK(files == frames.size());
    }
}
