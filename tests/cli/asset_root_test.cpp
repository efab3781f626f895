#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

using namespace gridreel::test;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// `models/tiny.gltf`, whose buffer lies in `shared/`.
struct Library {
    ScratchFolder folder;

    Library() {
        std::filesystem::create_directories(folder / "models");
        std::filesystem::create_directories(folder / "shared");
        write_tiny_scene(folder / "models");
        std::filesystem::rename(folder / "models/tiny.bin", folder / "shared/tiny.bin");
        json scene = json::parse(bytes_of(folder / "models/tiny.gltf"));
        scene["buffers"][0]["uri"] = "../shared/tiny.bin";
        write_file(folder / "models/tiny.gltf", scene.dump());
    }

    [[nodiscard]] Outcome run(const std::vector<std::string>& arguments) const {
        return run_gridreel(arguments, {.folder = folder.path()});
    }
};

const std::vector<std::string> small_picture{
    "render", "models/tiny.gltf", "-s",    "32x16",    "--spp", "1", "-f", "0",
    "-o",     "out.png",          "--log", "run.jsonl"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

}  // namespace

TEST_CASE("a file outside the scene's folder needs the asset root", "[cli][asset-root]") {
    const Library library;
    const Outcome refused = library.run(small_picture);
    CHECK(refused.exit_code == 3);
    CHECK_THAT(refused.err, Contains("/buffers/0/uri") && Contains("--asset-root"));

    const Outcome rendered = library.run(with(small_picture, {"--asset-root", "shared"}));
    INFO(rendered.err);
    REQUIRE(rendered.exit_code == 0);
    CHECK(read_log(library.folder / "run.jsonl")[0]["options"]["asset-root"] == "shared");
}

TEST_CASE("every command takes the asset root", "[cli][asset-root]") {
    const Library library;
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"info", "models/tiny.gltf"},
          {"bake", "models/tiny.gltf", "-f", "0", "-o", "out.ply"},
          {"bench", "models/tiny.gltf", "-f", "0", "-s", "32x16", "--repeat", "1"}}) {
        INFO(command[0]);
        CHECK(library.run(command).exit_code == 3);
        const Outcome outcome = library.run(with(command, {"--asset-root", "."}));
        INFO(outcome.err);
        CHECK(outcome.exit_code == 0);
    }
}

TEST_CASE("an asset root that is no folder is wrong usage", "[cli][asset-root]") {
    const Library library;
    for (const char* root : {"none", "shared/tiny.bin"}) {
        const Outcome outcome = library.run(with(small_picture, {"--asset-root", root}));
        CHECK(outcome.exit_code == 2);
        CHECK_THAT(outcome.err, Contains("there is no folder") && Contains(root));
    }
}

TEST_CASE("a job file's asset root is found beside it", "[cli][asset-root]") {
    const Library library;
    write_file(library.folder / "models/job.toml", "asset-root = \"../shared\"\n");
    const Outcome outcome = library.run(with(small_picture, {"--config", "models/job.toml"}));
    INFO(outcome.err);
    CHECK(outcome.exit_code == 0);
}
