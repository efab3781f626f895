#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace gridreel::test;
using Arguments = std::vector<std::string>;

namespace {

/// Messages are one line: program, kind, what and where.
bool is_one_error_line(const std::string& text) {
    return text.starts_with("gridreel: error: ") && text.find('\n') == text.size() - 1;
}

}  // namespace

TEST_CASE("help and version are not errors and go to stdout", "[cli][exit_code]") {
    const ScratchFolder folder;
    for (const Arguments& arguments : {Arguments{"--help"}, Arguments{"-h"}, Arguments{"render", "--help"},
                                       Arguments{"info", "-h"}, Arguments{"bake", "--help"}}) {
        const Outcome outcome = run_gridreel(arguments, {.folder = folder.path()});
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.out.find("Usage: gridreel") != std::string::npos);
        CHECK(outcome.err.empty());
    }
    for (const Arguments& arguments : {Arguments{"--version"}, Arguments{"render", "--version"}}) {
        const Outcome outcome = run_gridreel(arguments, {.folder = folder.path()});
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.out.starts_with("gridreel 0."));
    }
    // Defaults are shown.
    const std::string help = run_gridreel({"render", "--help"}, {.folder = folder.path()}).out;
    for (const char* text : {"--size WxH=1280x720", "--fps RATE=24", "--spp N=4", "frames/SCENE.####.exr"}) {
        INFO(text);
        CHECK(help.find(text) != std::string::npos);
    }
}

TEST_CASE("wrong usage is exit 2 and one line that says what", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const std::string scene = "tiny.gltf";
    for (const Arguments& arguments : {
             Arguments{},
             Arguments{"paint", scene},
             Arguments{"render"},
             Arguments{"render", scene, "--frobnicate"},
             Arguments{"render", scene, "--strict"},
             Arguments{"render", scene, "--chunk", "1/2"},
             Arguments{"render", scene, "another.glb"},
             Arguments{"render", scene, "-f", "5-1"},
             Arguments{"render", scene, "-f", "1-999999999"},
             Arguments{"render", scene, "-f", "one"},
             Arguments{"render", scene, "-f"},
             Arguments{"render", scene, "--fps", "0"},
             Arguments{"render", scene, "-s", "12"},
             Arguments{"render", scene, "--spp", "0"},
             Arguments{"render", scene, "--spp", "many"},
             Arguments{"render", scene, "-j", "0"},
             Arguments{"render", scene, "--accel", "magic"},
             Arguments{"render", scene, "--lambda", "-1"},
             Arguments{"render", scene, "--max-cells", "0"},
             Arguments{"render", scene, "--lights", "some"},
             Arguments{"render", scene, "--background", "reddish"},
             Arguments{"render", scene, "--exposure", "1000"},
             Arguments{"render", scene, "--scene", "first"},
             Arguments{"render", scene, "--scene", "7"},
             Arguments{"render", scene, "--animation", "nosuch"},
             Arguments{"render", scene, "--camera", "nosuch"},
             Arguments{"render", scene, "-o", "out/t.####.jpg"},
             Arguments{"render", scene, "-o", "out/t.####"},
             Arguments{"render", scene, "-o", "out/t.exr"},
             Arguments{"render", scene, "-o", "out/t.exr", "-f", "1-2"},
             Arguments{"render", scene, "-o", "out/##.##.exr"},
             Arguments{"render", scene, "-o", "out/t.####.png", "--aov", "z"},
             Arguments{"render", scene, "--aov", "albedo"},
             Arguments{"render", scene, "--compression", "dwaa"},
             Arguments{"render", scene, "--config", "none.toml"},
             Arguments{"render", scene, "--color", "purple"},
             Arguments{"info"},
             Arguments{"info", scene, "-f", "1"},
             Arguments{"bake", scene, "-o", "out/t.####.obj"},
             Arguments{"bake", scene, "-o", "out/t.ply"},
         }) {
        std::string line = "gridreel";
        for (const std::string& argument : arguments) line += ' ' + argument;
        INFO(line);
        const Outcome outcome = run_gridreel(arguments, {.folder = folder.path()});
        INFO(outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(is_one_error_line(outcome.err));
        CHECK(outcome.out.empty());
    }
    CHECK(folder.names() == std::vector<std::string>{"tiny.bin", "tiny.gltf"});
}

TEST_CASE("an empty value is not the default but exit 2", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto check = [&](const Arguments& arguments, const std::string& option) {
        INFO(arguments.front() << ' ' << option);
        const Outcome outcome = run_gridreel(arguments, {.folder = folder.path()});
        INFO(outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(is_one_error_line(outcome.err));
        CHECK(outcome.err.find(option + ": the value is empty") != std::string::npos);
    };
    for (const std::string option : {"--frames", "--output", "--log", "--aov", "--scene", "--config", "--fps",
                                     "--animation", "--camera", "--size", "--background"}) {
        check({"render", "tiny.gltf", option, ""}, option);
    }
    check({"render", "tiny.gltf", "-f", ""}, "--frames");
    check({"bake", "tiny.gltf", "-o", ""}, "--output");
    check({"bench", "tiny.gltf", "-f", ""}, "--frames");
    check({"--config", "", "info", "tiny.gltf"}, "--config");
    CHECK(folder.names() == std::vector<std::string>{"tiny.bin", "tiny.gltf"});
}

TEST_CASE("one frame needs no number in the output", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    CHECK(run_gridreel({"render", "tiny.gltf", "-s", "16x8", "-f", "3", "-o", "t.exr"},
                       {.folder = folder.path()})
              .exit_code == 0);
    CHECK(std::filesystem::exists(folder / "t.exr"));
    CHECK(std::filesystem::exists(folder / "t.jsonl"));
}

TEST_CASE("a scene that cannot be rendered is exit 3, and nothing is written", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_file(folder / "text.glb", "not a scene");
    write_file(folder / "empty.gltf", "");
    write_file(folder / "broken.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[7]}]})");
    write_file(folder / "strange.gltf",
               R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_x"],"extensionsUsed":["EXT_x"]})");
    for (const std::string command : {"render", "info", "bake"}) {
        for (const std::string name :
             {"missing.glb", "text.glb", "empty.gltf", "broken.gltf", "strange.gltf", "."}) {
            INFO(command << ' ' << name);
            const Outcome outcome = run_gridreel({command, name}, {.folder = folder.path()});
            INFO(outcome.err);
            CHECK(outcome.exit_code == 3);
            CHECK(is_one_error_line(outcome.err));
            CHECK(outcome.err.find(name == "." ? "error" : name) != std::string::npos);
        }
    }
    CHECK_FALSE(std::filesystem::exists(folder / "frames"));
}

TEST_CASE("output that cannot be written is exit 4 and names the place", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    write_file(folder / "file", "in the way");
    const auto run = [&](Arguments arguments) {
        arguments.insert(arguments.begin() + 1, "tiny.gltf");
        return run_gridreel(arguments, {.folder = folder.path()});
    };
    for (const std::string command : {"render", "bake"}) {
        const std::string pattern = command == "render" ? "file/t.####.exr" : "file/t.####.ply";
        const Outcome outcome = run({command, "-f", "0", "-s", "16x8", "-o", pattern});
        CHECK(outcome.exit_code == 4);
        CHECK(is_one_error_line(outcome.err.substr(outcome.err.find("gridreel: error"))));
        CHECK(outcome.err.find("file") != std::string::npos);
    }
    CHECK(run({"render", "-f", "0", "-s", "16x8", "-o", "out/t.exr", "--log", "file/t.jsonl"}).exit_code ==
          4);
    CHECK(run({"render", "-f", "0", "-s", "16x8", "-o", "out/t.exr", "--log", "/dev/full"}).exit_code == 4);
}

TEST_CASE("messages that cannot be written do not change the exit code", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Setting full{.folder = folder.path(), .err_file = "/dev/full"};
    CHECK(run_gridreel({"render", "nope.glb"}, full).exit_code == 3);
    CHECK(run_gridreel({"render", "--frobnicate"}, full).exit_code == 2);
    CHECK(run_gridreel({"render", "tiny.gltf", "-s", "16x8", "-f", "0", "-o", "t.exr"}, full).exit_code == 0);
}

TEST_CASE("results that cannot be written are exit 4", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Setting full{.folder = folder.path(), .out_file = "/dev/full"};
    for (const Arguments& arguments :
         {Arguments{"info", "tiny.gltf"}, Arguments{"info", "tiny.gltf", "--json"},
          Arguments{"bake", "tiny.gltf", "-q", "-f", "0", "-o", "t.ply"}}) {
        INFO(arguments.front());
        const Outcome outcome = run_gridreel(arguments, full);
        const bool quiet = arguments.front() == "bake";  // asks for no results
        CHECK(outcome.exit_code == (quiet ? 0 : 4));
        CHECK(is_one_error_line(outcome.err) == !quiet);
        CHECK((outcome.err.find("stdout") != std::string::npos) == !quiet);
    }
}

TEST_CASE("a frame that cannot be written ends the run, or is skipped on request", "[cli][exit_code]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    std::filesystem::create_directories(folder / "out/t.0001.exr/in the way");
    const Arguments render{"render", "tiny.gltf", "-s", "16x8", "-f", "0-3", "-o", "out/t.####.exr"};

    const Outcome ended = run_gridreel(render, {.folder = folder.path()});
    CHECK(ended.exit_code == 4);
    CHECK(ended.err.find("out/t.0001.exr") != std::string::npos);
    CHECK(std::filesystem::exists(folder / "out/t.0000.exr"));
    CHECK_FALSE(std::filesystem::exists(folder / "out/t.0003.exr"));

    std::filesystem::remove(folder / "out/t.jsonl");
    Arguments keep_going = render;
    keep_going.push_back("--keep-going");
    const Outcome skipped = run_gridreel(keep_going, {.folder = folder.path()});
    CHECK(skipped.exit_code == 5);
    CHECK(skipped.err.find("frame 1: ") != std::string::npos);
    CHECK(std::filesystem::exists(folder / "out/t.0003.exr"));
    const auto frames = frames_of(folder / "out/t.jsonl");
    REQUIRE(frames.size() == 4);
    for (int i = 0; i < 4; ++i) {
        CHECK(frames[std::size_t(i)]["frame"] == i);
        CHECK(frames[std::size_t(i)].contains("error") == (i == 1));
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        CHECK(entry.path().extension() != ".part");
    }
}
