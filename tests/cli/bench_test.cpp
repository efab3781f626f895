#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"
#include "traversal/simd_target.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

using namespace gridreel::test;
using Catch::Matchers::Contains;

TEST_CASE("bench compares structures and writes no images", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto before = folder.names();
    const Outcome outcome = run_gridreel({"bench", "tiny.gltf", "-f", "0-1", "-s", "32x32", "--repeat", "2",
                                          "--accel", "grid,grid-single,naive", "--threads", "1,2"},
                                         {.folder = folder.path()});
    CHECK(outcome.exit_code == 0);
    CHECK(folder.names() == before);
    CHECK_THAT(outcome.out, Contains("grid against grid-single, 1 thread:"));
    CHECK_THAT(outcome.out, Contains("grid against naive, 2 threads:"));
    CHECK_THAT(outcome.out, Contains("primary"));
}

TEST_CASE("bench refuses what it cannot compare", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto exit_code = [&](const std::string& option, const std::string& value) {
        return run_gridreel({"bench", "tiny.gltf", option, value}, {.folder = folder.path()}).exit_code;
    };
    CHECK(exit_code("--accel", "octree") == 2);
    CHECK(exit_code("--threads", "0") == 2);
    CHECK(exit_code("--repeat", "0") == 2);
}

TEST_CASE("GRIDREEL_TARGET caps the instruction set", "[cli][simd]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto render = [&](const char* target) {
        setenv("GRIDREEL_TARGET", target, 1);
        const Outcome outcome =
            run_gridreel({"render", "tiny.gltf", "-f", "0", "-s", "32x32", "--log", "run.jsonl"},
                         {.folder = folder.path()});
        unsetenv("GRIDREEL_TARGET");
        return outcome;
    };
    // What there is depends on the machine.
    const Outcome refused = render("abacus");
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.err, Contains("abacus"));
    for (const std::string_view name : gridreel::traversal::simd_targets()) {
        const std::string target(name);
        INFO(target);
        CHECK_THAT(refused.err, Contains(target));
        std::filesystem::remove(folder / "run.jsonl");
        CHECK(render(target.c_str()).exit_code == 0);
        CHECK(read_log(folder / "run.jsonl").front()["instruction_set"] == target);
    }
}
