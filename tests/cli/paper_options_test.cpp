#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <set>
#include <string>
#include <vector>

using namespace gridreel::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Few and small runs: what is checked is the report, never the time.
Outcome bench(const ScratchFolder& folder, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"bench", "tiny.gltf", "-f", "0",  "-s", "64x64",  "--repeat",
                                       "1",     "--warmup",  "0",  "-j", "1",  "--json", "out.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_gridreel(arguments, {.folder = folder.path()});
}

json read_json(const ScratchFolder& folder) {
    std::ifstream stream(folder / "out.json");
    return json::parse(stream);
}

/// Runs it, which must succeed. @return the names of what was compared
std::set<std::string> competitors(const ScratchFolder& folder, const std::vector<std::string>& more) {
    const Outcome outcome = bench(folder, more);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    std::set<std::string> names;
    const json results = read_json(folder);
    for (const json& benchmark : results["benchmarks"]) names.insert(benchmark["accel"]);
    return names;
}

using Names = std::set<std::string>;

}  // namespace

TEST_CASE("bench compares packets of several sides", "[cli][bench][paper]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    CHECK(competitors(folder, {"--packet", "1,4,8,16", "--accel", "grid-single,grid"}) ==
          Names{"grid-single", "grid:packet=1", "grid:packet=4", "grid:packet=8", "grid:packet=16"});
    CHECK(competitors(folder, {"--packet", "2,auto"}) == Names{"grid:packet=2", "grid:packet=auto"});
}

TEST_CASE("labels name what is varied and nothing else", "[cli][bench][paper]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    CHECK(competitors(folder, {"--packet", "8", "--culling", "off", "--mailbox", "on"}) == Names{"grid"});
    CHECK(competitors(folder, {"--packet", "16", "--culling", "on,off", "--mailbox", "on,off"}) ==
          Names{"grid:culling=on,mailbox=on", "grid:culling=on,mailbox=off", "grid:culling=off,mailbox=on",
                "grid:culling=off,mailbox=off"});
    CHECK(competitors(folder, {"--lambda", "1,paper", "--packet", "8,16", "--accel", "grid,grid-single"}) ==
          Names{"grid:1,packet=8", "grid:1,packet=16", "grid:paper,packet=8", "grid:paper,packet=16",
                "grid-single:1", "grid-single:paper"});
}

TEST_CASE("bench compares grids that know what stands still with grids that do not", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    CHECK(competitors(folder, {"--still", "unknown"}) == Names{"grid"});
    CHECK(competitors(folder, {"--still", "known,unknown", "--accel", "grid-single"}) ==
          Names{"grid-single:still=known", "grid-single:still=unknown"});
    CHECK(competitors(folder, {"--still", "known,unknown", "--lambda", "1,2", "--packet", "4,8"})
              .count("grid:2,still=known,packet=8") == 1);
    CHECK(bench(folder, {"--still", "maybe"}).exit_code == 2);
}

TEST_CASE("macrocells are a switch, and a list of both", "[cli][bench][paper]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    CHECK(competitors(folder, {"--macrocells"}) == Names{"grid"});
    CHECK(competitors(folder, {"--macrocells", "--culling", "on,off"}) ==
          Names{"grid:culling=on", "grid:culling=off"});
    const Names both{"grid:macrocells=off", "grid:macrocells=on"};
    CHECK(competitors(folder, {"--macrocells", "off,on"}) == both);
    CHECK(competitors(folder, {"--macrocells=off,on"}) == both);

    // It is really on: it takes memory.
    const auto bytes = [&](const std::vector<std::string>& more) {
        REQUIRE(bench(folder, more).exit_code == 0);
        const json results = read_json(folder);
        for (const json& benchmark : results["benchmarks"]) {
            if (benchmark["phase"] == "rebuild") return benchmark["bytes_per_triangle"].get<double>();
        }
        return 0.0;
    };
    CHECK(bytes({"--macrocells"}) > bytes({"--macrocells", "off"}));
    CHECK(bytes({"--macrocells=on"}) > bytes({}));
}

TEST_CASE("the counters tell what culling is worth", "[cli][bench][paper]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome = bench(folder, {"--packet", "4", "--culling", "on,off"});
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("primary: ") && Contains(" tests a ray"));
    double with = 0.0, without = 0.0;
    const json results = read_json(folder);
    for (const json& benchmark : results["benchmarks"]) {
        if (benchmark["phase"] == "rebuild") CHECK_FALSE(benchmark.contains("cells_per_ray"));
        if (benchmark["phase"] != "primary") continue;
        CHECK(benchmark["cells_per_ray"].get<double>() > 0.0);
        (benchmark["accel"] == "grid:culling=on" ? with : without) = benchmark["triangle_tests_per_ray"];
    }
    CHECK(with > 0.0);
    CHECK(with < without);
}

TEST_CASE("packets are refused by name where they cannot be had", "[cli][bench][paper]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto refuse = [&](const std::vector<std::string>& more, const std::string& what,
                            const std::string& remedy) {
        const Outcome outcome = bench(folder, more);
        INFO(more.front() << " " << more.back());
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, Contains(more.front().substr(0, more.front().find('='))) && Contains(what) &&
                                    Contains(remedy));
    };
    for (const std::string side : {"0", "3", "17", "-1", "8x8", "4,5"})
        refuse({"--packet=" + side}, "no side of a packet", "1, 2, 4, 8, 16, and auto");
    for (const std::string option : {"--culling", "--mailbox", "--macrocells"}) {
        refuse({option, "maybe"}, "'maybe' is neither on nor off", option + " on,off");
        refuse({option, "on,perhaps"}, "neither on nor off", option + " on,off");
    }
    refuse({"--macrocells", "tiny.gltf"}, "'tiny.gltf' is neither on nor off", "--macrocells on");
    refuse({"--packet", "4", "--accel", "grid-single,naive"}, "packets of the grid", "add grid to --accel");
    refuse({"--macrocells", "off", "--accel", "naive"}, "packets of the grid", "add grid to --accel");
    CHECK(bench(folder, {"--packet", "8,8"}).exit_code == 2);
    CHECK(bench(folder, {"--culling", "off,off"}).exit_code == 2);
    CHECK(bench(folder, {"--packet", ""}).exit_code == 2);
    CHECK(run_gridreel({"render", "tiny.gltf", "-f", "0", "--packet", "4"}, {.folder = folder.path()})
              .exit_code == 2);
}

TEST_CASE("a job file can switch what packets are made of", "[cli][bench][paper]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    std::ofstream(folder / "job.toml")
        << "[bench]\npacket = [4, 8]\nculling = \"on,off\"\nmacrocells = true\n";
    CHECK(competitors(folder, {"--config", "job.toml"}) ==
          Names{"grid:packet=4,culling=on", "grid:packet=4,culling=off", "grid:packet=8,culling=on",
                "grid:packet=8,culling=off"});
}
