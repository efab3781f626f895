#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>

using namespace gridreel::test;
using nlohmann::json;

TEST_CASE("info says what a scene holds, for scripts", "[cli][info]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome =
        run_gridreel({"info", "tiny.gltf", "--json", "--fps", "30"}, {.folder = folder.path()});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const json info = json::parse(outcome.out);
    CHECK(info["schema"] == "gridreel.info/1");
    CHECK(info["animations"] ==
          json::parse(R"([{"name": "Slide", "duration_s": 1.0, "frames": [0, 30], "plays": true}])"));
    CHECK(info["frames"] == json{0, 30});
    CHECK(info["cameras"].size() == 1);
    CHECK(info["cameras"][0]["node"] == "Cam");
    CHECK(info["cameras"][0]["kind"] == "perspective");
    CHECK(info["lights"].empty());
    CHECK(info["triangles"] == json::parse(R"({"moving": 1, "still": 1})"));
    CHECK(info["vertices"] == 6);
    // The moving triangle reaches x = 3, the still one lies at z = -1.
    CHECK(info["bounds"]["min"] == json{0.0, 0.0, -1.0});
    CHECK(info["bounds"]["max"] == json{3.0, 1.0, 0.0});
    CHECK(info["materials"] == json{"Red"});
    CHECK(info["extensions_used"].empty());
    CHECK(info["warnings"].is_array());
}

TEST_CASE("info says what a scene holds, for people", "[cli][info]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome = run_gridreel({"info", "tiny.gltf"}, {.folder = folder.path()});
    REQUIRE(outcome.exit_code == 0);
    for (const char* text :
         {"0 Slide: 1 s, frames 0-24 at 24 fps, plays", "0 Cam (perspective)",
          "1 moving, 1 still, 6 vertices", "(0, 0, -1) to (3, 1, 0) m", "Red", "used none; required none"}) {
        INFO(text);
        CHECK(outcome.out.find(text) != std::string::npos);
    }
}

TEST_CASE("without its animation nothing in the scene moves", "[cli][info]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome =
        run_gridreel({"info", "tiny.gltf", "--json", "--animation", "none"}, {.folder = folder.path()});
    REQUIRE(outcome.exit_code == 0);
    const json info = json::parse(outcome.out);
    CHECK(info["triangles"] == json::parse(R"({"moving": 0, "still": 2})"));
    CHECK(info["frames"] == json{0, 0});
    CHECK(info["animations"][0]["plays"] == false);
}
