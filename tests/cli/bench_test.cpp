#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"
#include "traversal/lambda_chooser.h"
#include "traversal/simd_target.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

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

namespace {

/// Few and small runs: what is checked is the report, never the time.
std::vector<std::string> quick_bench(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"bench", "tiny.gltf", "-f", "0",  "-s",
                                       "16x16", "--repeat",  "3",  "-j", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

nlohmann::json read_json(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return nlohmann::json::parse(stream);
}

void write_text(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

nlohmann::json find_benchmark(const nlohmann::json& json, const std::string& name) {
    for (const auto& benchmark : json["benchmarks"]) {
        if (benchmark["name"] == name) return benchmark;
    }
    return {};
}

}  // namespace

TEST_CASE("bench refuses what it cannot compare", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto exit_code = [&](const std::string& option, const std::string& value) {
        return run_gridreel({"bench", "tiny.gltf", option, value}, {.folder = folder.path()}).exit_code;
    };
    CHECK(exit_code("--accel", "octree") == 2);
    CHECK(exit_code("--accel", "grid,grid") == 2);
    CHECK(exit_code("--threads", "0") == 2);
    CHECK(exit_code("--repeat", "0") == 2);
    CHECK(exit_code("--warmup", "-1") == 2);
    CHECK(exit_code("--phase", "shade") == 2);
    CHECK(exit_code("--lambda", "1,0") == 2);
    CHECK(exit_code("--lambda", "1,many") == 2);
    CHECK(exit_code("--lambda", "auto,auto") == 2);
    CHECK(exit_code("--embree-quality", "high") == 2);
    CHECK(exit_code("--embree-rays", "many") == 2);
    CHECK(exit_code("--fail-if", "10%") == 2);
    CHECK(run_gridreel({"bench"}, {.folder = folder.path()}).exit_code == 2);

    const Outcome unknown =
        run_gridreel({"bench", "tiny.gltf", "--accel", "octree"}, {.folder = folder.path()});
    CHECK_THAT(unknown.err, Contains("octree") && Contains("grid-single"));
    const Outcome twins = run_gridreel({"bench", "tiny.gltf", "./tiny.gltf"}, {.folder = folder.path()});
    CHECK(twins.exit_code == 2);
    CHECK_THAT(twins.err, Contains("same name"));
}

TEST_CASE("the accel embree traces, or says how to get Embree", "[cli][bench][embree]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome bench = run_gridreel(quick_bench({"--accel", "grid,embree", "--embree-quality",
                                                    "low,medium,refit", "--bounce", "--json", "out.json"}),
                                       {.folder = folder.path()});
    const Outcome render = run_gridreel(
        {"render", "tiny.gltf", "-f", "0", "-s", "16x16", "--accel", "embree"}, {.folder = folder.path()});
    if (!gridreel::traversal::is_built_in(gridreel::traversal::TracerKind::embree)) {
        for (const Outcome& outcome : {bench, render}) {
            CHECK(outcome.exit_code == 2);
            CHECK_THAT(outcome.err, Contains("libembree-dev"));
        }
        return;
    }
    CHECK(bench.exit_code == 0);
    CHECK(render.exit_code == 0);
    std::set<std::string> against;
    const auto json = read_json(folder / "out.json");
    for (const auto& ratio : json["ratios"]) against.insert(ratio["against"]);
    CHECK(against == std::set<std::string>{"embree", "embree-medium", "embree-refit"});
    const auto bounce = find_benchmark(json, "tiny/embree/threads:1/bounce");
    const std::set<std::string> ways{"packets", "sorted packets", "single"};
    CHECK(ways.count(bounce["rays"].get<std::string>()) == 1);
}

TEST_CASE("bench writes Google Benchmark's shape with raw times and ratios", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome = run_gridreel(
        {"bench", "--accel", "grid,grid-single", "tiny.gltf", "-f", "0-1", "-s", "16x16", "--repeat", "3",
         "--threads", "1,2", "--bounce", "--json", "new/out.json", "--markdown", "new/out.md"},
        {.folder = folder.path()});
    REQUIRE(outcome.exit_code == 0);
    const auto json = read_json(folder / "new" / "out.json");
    CHECK(json["context"]["num_cpus"].get<int>() >= 1);
    CHECK(json["context"].contains("library_build_type"));

    // 2 structures, 2 numbers of threads, 7 phases.
    CHECK(json["benchmarks"].size() == 28);
    for (const auto& benchmark : json["benchmarks"]) {
        INFO(benchmark["name"]);
        CHECK(benchmark["run_type"] == "aggregate");
        CHECK(benchmark["time_unit"] == "ms");
        REQUIRE(benchmark["times"].size() == 6);  // 2 frames, 3 runs each
        std::vector<double> times = benchmark["times"];
        std::sort(times.begin(), times.end());
        CHECK(benchmark["real_time"].get<double>() == Approx((times[2] + times[3]) / 2.0));
        CHECK(benchmark["min"].get<double>() == times.front());
        CHECK(benchmark["p95"].get<double>() == times.back());
    }
    const auto primary = find_benchmark(json, "tiny/grid/threads:2/primary");
    CHECK(primary["items_per_second"].get<double>() > 0.0);
    const auto rebuild = find_benchmark(json, "tiny/grid/threads:1/rebuild");
    CHECK(rebuild["triangles"]["moving"] == 1);
    CHECK(rebuild["triangles"]["still"] == 1);
    CHECK(rebuild["cells"].get<int>() >= 1);
    CHECK(rebuild["bytes_per_triangle"].get<double>() > 0.0);
    const auto frame = find_benchmark(json, "tiny/grid/threads:1/frame");
    CHECK(frame["rebuild_share"].get<double>() > 0.0);
    CHECK(frame["rebuild_share"].get<double>() < 1.0);

    // The scene has no light of its own: the default one casts shadows.
    std::set<std::string> phases;
    for (const auto& ratio : json["ratios"]) {
        CHECK(ratio["scene"] == "tiny");
        CHECK(ratio["against"] == "grid-single");
        CHECK((ratio["threads"] == 1 || ratio["threads"] == 2));
        CHECK(ratio["speedup"].get<double>() ==
              Approx(ratio["theirs_ms"].get<double>() / ratio["ours_ms"].get<double>()));
        const std::string phase = ratio["phase"];
        const std::string name = "/threads:" + std::to_string(ratio["threads"].get<int>()) + "/" + phase;
        CHECK(ratio["ours_ms"] == find_benchmark(json, "tiny/grid" + name)["real_time"]);
        CHECK(ratio["theirs_ms"] == find_benchmark(json, "tiny/grid-single" + name)["real_time"]);
        phases.insert(phase);
    }
    CHECK(json["ratios"].size() == 10);
    CHECK(phases == std::set<std::string>{"rebuild", "primary", "shadow", "bounce", "frame"});

    std::ifstream markdown(folder / "new" / "out.md");
    std::string line;
    std::getline(markdown, line);
    CHECK_THAT(line, Contains("| scene | triangles | threads |") && Contains("| primary, grid-single |"));
    std::size_t rows = 0;
    while (std::getline(markdown, line)) rows += line.starts_with("| tiny | 2 |");
    CHECK(rows == 2);
    // Whole files only: nothing is left of the names they were written under.
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "new"), {}) == 2);
}

TEST_CASE("bench measures the clip's last frame by name", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto runs = [&](const std::string& frames) {
        std::vector<std::string> arguments = quick_bench({"--json", "out.json"});
        *(std::find(arguments.begin(), arguments.end(), "-f") + 1) = frames;
        CHECK(run_gridreel(arguments, {.folder = folder.path()}).exit_code == 0);
        return find_benchmark(read_json(folder / "out.json"), "tiny/grid/threads:1/frame")["times"].size();
    };
    CHECK(runs("0,last") == 6);
    CHECK(runs("24,last") == 3);  // frame 24 is the last
    CHECK(run_gridreel({"bench", "tiny.gltf", "-f", "0-last"}, {.folder = folder.path()}).exit_code == 2);
}

TEST_CASE("bench sweeps lambda, a competitor for each", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome = run_gridreel(quick_bench({"--lambda", "0.5,2,paper", "--json", "out.json"}),
                                         {.folder = folder.path()});
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("grid:0.5 against grid:2, 1 thread:") && Contains("grid:paper"));
    CHECK(!find_benchmark(read_json(folder / "out.json"), "tiny/grid:2/threads:1/rebuild").is_null());
}

TEST_CASE("bench sets a lambda chosen by cost beside fixed ones", "[cli][bench][lambda]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    for (const std::string phase : {"all", "rebuild", "trace"}) {
        for (const std::string warmup : {"0", "1"}) {
            INFO(phase << ", " << warmup);
            const Outcome outcome =
                run_gridreel(quick_bench({"--lambda", "3,auto", "--accel", "grid,grid-single,naive",
                                          "--phase", phase, "--warmup", warmup, "--json", "out.json"}),
                             {.folder = folder.path()});
            REQUIRE(outcome.exit_code == 0);
            CHECK_THAT(outcome.out, Contains("grid:3 against grid:auto, 1 thread:"));
            if (phase == "trace") continue;
            const auto json = read_json(folder / "out.json");
            CHECK(find_benchmark(json, "tiny/grid:3/threads:1/rebuild")["lambda"] == 3.0);
            for (const std::string accel : {"grid", "grid-single"}) {
                const float chosen =
                    find_benchmark(json, "tiny/" + accel + ":auto/threads:1/rebuild")["lambda"];
                const auto& ladder = gridreel::traversal::LambdaChooser::ladder;
                CHECK(std::find(ladder.begin(), ladder.end(), chosen) != ladder.end());
            }
        }
    }
}

TEST_CASE("bench measures one phase alone", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto phases = [&](const std::string& phase) {
        CHECK(run_gridreel(quick_bench({"--phase", phase, "--accel", "grid,naive", "--json", "out.json"}),
                           {.folder = folder.path()})
                  .exit_code == 0);
        std::set<std::string> names;
        const auto json = read_json(folder / "out.json");
        for (const auto& ratio : json["ratios"]) names.insert(ratio["phase"]);
        return names;
    };
    CHECK(phases("rebuild") == std::set<std::string>{"rebuild"});
    CHECK(phases("trace") == std::set<std::string>{"primary", "shadow"});
    CHECK(phases("all") == std::set<std::string>{"rebuild", "primary", "shadow", "frame"});
}

TEST_CASE("bench holds a run against an earlier one", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    REQUIRE(run_gridreel(quick_bench({"--json", "old.json"}), {.folder = folder.path()}).exit_code == 0);
    auto old = read_json(folder / "old.json");
    const auto with_times = [&](double factor) {
        auto changed = old;
        for (auto& benchmark : changed["benchmarks"])
            benchmark["real_time"] = benchmark["real_time"].get<double>() * factor;
        write_text(folder / "baseline.json", changed.dump());
    };
    const auto compare = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments = quick_bench({"--baseline", "baseline.json"});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_gridreel(arguments, {.folder = folder.path()});
    };

    // An old run a million times as slow, then as quick: no noise reaches that far.
    with_times(1e6);
    const Outcome better = compare({"--fail-if", "10%"});
    CHECK(better.exit_code == 0);
    CHECK_THAT(better.out, Contains("0 of 4 phases slower than the baseline by more than 10%"));
    with_times(1e-6);
    const Outcome worse = compare({"--fail-if", "10%"});
    CHECK(worse.exit_code == 1);
    CHECK_THAT(worse.out, Contains("tiny/grid/threads:1/rebuild: ") && Contains("% slower") &&
                              Contains("4 of 4 phases slower"));
    CHECK(compare({}).exit_code == 0);  // only reports
    CHECK(compare({"--fail-if", "much"}).exit_code == 2);
    CHECK(compare({"--fail-if=-5%"}).exit_code == 2);

    // What the baseline lacks is named; if it has nothing, that is a mistake.
    old["benchmarks"].erase(1);
    with_times(1e6);
    const Outcome lacking = compare({"--fail-if", "10%"});
    CHECK(lacking.exit_code == 0);
    CHECK_THAT(lacking.err, Contains("not in the baseline: tiny/grid/threads:1/rebuild"));
    CHECK(compare({"--accel", "naive"}).exit_code == 2);
}

TEST_CASE("bench refuses baselines that it cannot read, before it measures", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto refuse = [&](const std::string& text, const std::string& reason) {
        if (!text.empty()) write_text(folder / "old.json", text);
        const Outcome outcome =
            run_gridreel(quick_bench({"--baseline", "old.json"}), {.folder = folder.path()});
        INFO(text);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.out.empty());
        CHECK_THAT(outcome.err, Contains("old.json") && Contains(reason));
    };
    refuse("", "cannot be read");
    refuse("{\"benchmarks\": [", "not JSON");
    refuse("[1, 2]", "no array");
    refuse("{\"benchmarks\": 7}", "no array");
    refuse("{\"benchmarks\": [{\"name\": \"x\"}]}", "lacks");
    refuse("{\"benchmarks\": [{\"name\": \"x\", \"real_time\": \"fast\", \"time_unit\": \"ms\"}]}", "lacks");
    refuse("{\"benchmarks\": [{\"name\": \"x\", \"real_time\": 1, \"time_unit\": \"ns\"}]}", "lacks");
}

TEST_CASE("one scene that fails does not take the others with it", "[cli][bench]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    write_text(folder / "broken.gltf", "{}");
    std::vector<std::string> arguments = quick_bench({"--json", "out.json"});
    arguments.insert(arguments.begin() + 1, "broken.gltf");
    const Outcome outcome = run_gridreel(arguments, {.folder = folder.path()});
    CHECK(outcome.exit_code == 3);
    CHECK_THAT(outcome.err, Contains("broken.gltf"));
    CHECK_THAT(outcome.out, Contains("tiny: 1 triangles moving"));
    CHECK(read_json(folder / "out.json")["benchmarks"].size() > 0);
}

TEST_CASE("a job file can name the scenes of a benchmark", "[cli][bench]") {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "scenes");
    write_tiny_scene(folder / "scenes");
    std::filesystem::copy(folder / "scenes" / "tiny.gltf", folder / "scenes" / "other.gltf");
    write_text(
        folder / "scenes" / "job.toml",
        "input = [\"tiny.gltf\", \"other.gltf\"]\n[bench]\nframes = \"0\"\nsize = \"16x16\"\nrepeat = 1\n");
    const Outcome outcome =
        run_gridreel({"bench", "--config", "scenes/job.toml", "-j", "1"}, {.folder = folder.path()});
    CHECK(outcome.exit_code == 0);
    CHECK_THAT(outcome.out, Contains("tiny: ") && Contains("other: "));
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
