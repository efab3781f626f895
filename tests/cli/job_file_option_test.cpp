#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace gridreel::test;

namespace {

/// A job of its own folder, and a current folder elsewhere.
struct Jobs {
    ScratchFolder job_folder;
    ScratchFolder here;

    explicit Jobs(const std::string& job) {
        write_tiny_scene(job_folder.path());
        write_file(job_folder / "job.toml", job);
    }

    Outcome run(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--config", (job_folder / "job.toml").string()});
        return run_gridreel(arguments, {.folder = here.path()});
    }
};

constexpr const char* small_job = R"(fps = 4
[render]
input = "tiny.gltf"
output = "out/t.####.exr"
size = "32x16"
spp = 1
frames = "0-1"
aov = ["z", "n"]
background = "#ff0000"
[bake]
normals = true
)";

}  // namespace

TEST_CASE("a job file holds the scene beside it and the options", "[cli][config]") {
    const Jobs jobs(small_job);
    const Outcome outcome = jobs.run({"render"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    // What is written goes to the current folder.
    const auto lines = read_log(jobs.here / "out/t.jsonl");
    REQUIRE(lines.size() == 3);
    CHECK(lines[0]["options"]["fps"] == "4");
    CHECK(lines[0]["options"]["size"] == nlohmann::json{32, 16});
    CHECK(lines[0]["options"]["spp"] == 1);
    CHECK(lines[0]["options"]["aov"] == nlohmann::json{"z", "n"});
    CHECK(lines[0]["options"]["background"] == nlohmann::json{1.0, 0.0, 0.0, 1.0});
    CHECK(std::filesystem::exists(jobs.here / "out/t.0001.exr"));
    CHECK(jobs.job_folder.names() == std::vector<std::string>{"job.toml", "tiny.bin", "tiny.gltf"});
}

TEST_CASE("the command line wins over the job file", "[cli][config]") {
    const Jobs jobs(small_job);
    REQUIRE(jobs.run({"render", "-f", "2", "-s", "16x8", "-o", "mine.####.exr"}).exit_code == 0);
    const auto lines = read_log(jobs.here / "mine.jsonl");
    REQUIRE(lines.size() == 2);
    CHECK(lines[0]["options"]["size"] == nlohmann::json{16, 8});
    CHECK(lines[0]["options"]["spp"] == 1);
    CHECK(lines[1]["frame"] == 2);
    CHECK(lines[1]["time_s"] == 0.5);
}

TEST_CASE("a scene on the command line is found from the current folder", "[cli][config]") {
    const Jobs jobs(small_job);
    CHECK(jobs.run({"render", "tiny.gltf"}).exit_code == 3);
    CHECK(jobs.run({"render", (jobs.job_folder / "tiny.gltf").string(), "-q"}).exit_code == 0);
}

TEST_CASE("a command reads its own section", "[cli][config]") {
    const Jobs jobs(small_job);
    const std::string scene = (jobs.job_folder / "tiny.gltf").string();
    REQUIRE(jobs.run({"bake", scene, "-o", "t.####.ply"}).exit_code == 0);
    CHECK(bytes_of(jobs.here / "t.0004.ply").find("property float nx") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(jobs.here / "t.0005.ply"));
    CHECK(jobs.run({"info", scene}).exit_code == 0);
}

TEST_CASE("what a job file gets wrong is exit 2, with file and line", "[cli][config]") {
    for (const std::string wrong : {"sppp = 4", "spp = 0", "spp = \"many\"", "spp", "help = true",
                                    "config = \"x\"", "lights = \"some\"", "output = out.exr"}) {
        INFO(wrong);
        const Jobs jobs("[render]\ninput = \"tiny.gltf\"\n" + wrong + "\n");
        const Outcome outcome = jobs.run({"render"});
        INFO(outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find("job.toml:3: ") != std::string::npos);
    }
    CHECK(Jobs("[redner]\nspp = 1\n").run({"render"}).exit_code == 2);
    CHECK(Jobs("[render]\nspp = 1\n").run({"render"}).exit_code == 2);  // no scene
}

TEST_CASE("flags can stand in a job file", "[cli][config]") {
    const Jobs jobs(
        "[render]\ninput = \"tiny.gltf\"\nquiet = true\nkeep-going = false\nsize = \"16x8\"\nframes = 0\n");
    const Outcome outcome = jobs.run({"render"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.empty());
}

TEST_CASE("every bundled job renders", "[cli][config]") {
    for (const std::string name : {"marbles", "walker", "sheet", "stadium"}) {
        INFO(name);
        const ScratchFolder here;
        const Outcome outcome = run_gridreel({"render", "--config", GRIDREEL_GALLERY "/" + name + "/job.toml",
                                              "-f", "1", "-s", "32x18", "--spp", "1", "--log", "log.jsonl"},
                                             {.folder = here.path()});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        const auto frames = frames_of(here / "log.jsonl");
        REQUIRE(frames.size() == 1);
        CHECK(frames[0]["triangles"]["moving"] > 0);
        CHECK(std::filesystem::exists(here / frames[0]["file"]));
    }
}

TEST_CASE("common options before the command win over the job file", "[cli][config]") {
    const Jobs jobs("color = \"always\"\ninput = \"missing.gltf\"\n");
    const std::string escape = "\x1b[";
    const Outcome coloured = jobs.run({"render"});
    CHECK(coloured.exit_code == 3);
    CHECK(coloured.err.find(escape) != std::string::npos);
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--color", "never", "render"}, {"render", "--color", "never"}}) {
        const Outcome plain = jobs.run(arguments);
        CHECK(plain.exit_code == 3);
        CHECK(plain.err.find(escape) == std::string::npos);
    }
}
