#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstring>
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
    const json& memory = info["memory_estimate"];
    std::size_t sum = 0;
    for (const char* const part : {"program", "scene", "geometry", "textures", "grid", "films", "rays"}) {
        sum += memory[part].get<std::size_t>();
    }
    CHECK(memory["total"] == sum);
    // Three corners of position, indices that count up, and the keys: 2 times, 2 translations.
    CHECK(memory["scene"] == 3 * 12 + 12 + 2 * 4 + 2 * 12);
    CHECK(memory["textures"] == 0);
    CHECK(memory["assumed"]["size"] == json{1280, 720});
}

TEST_CASE("info says which extensions pictures show", "[cli][info]") {
    const ScratchFolder folder;
    std::string scene = bytes_of(write_tiny_scene(folder.path()));
    scene.insert(scene.rfind('}'), R"(, "extensionsUsed": ["KHR_materials_unlit", "KHR_materials_ior", "X_y"],
                                       "extensionsRequired": ["KHR_materials_unlit"])");
    write_file(folder.path() / "tiny.gltf", scene);

    const std::string page = run_gridreel({"info", "tiny.gltf"}, {.folder = folder.path()}).out;
    CHECK(page.find("used KHR_materials_unlit, KHR_materials_ior, X_y\n") != page.npos);
    CHECK(page.find("required KHR_materials_unlit\n") != page.npos);
    CHECK(page.find("supported KHR_materials_unlit\n") != page.npos);
    const json info =
        json::parse(run_gridreel({"info", "tiny.gltf", "--json"}, {.folder = folder.path()}).out);
    CHECK(info["extensions_supported"] == json{"KHR_materials_unlit"});
}

TEST_CASE("info says what a scene holds, for people", "[cli][info]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome = run_gridreel({"info", "tiny.gltf"}, {.folder = folder.path()});
    REQUIRE(outcome.exit_code == 0);
    for (const char* text : {"0 Slide: 1 s, frames 0-24 at 24 fps, plays", "0 Cam (perspective)",
                             "1 moving, 1 still, 6 vertices", "(0, 0, -1) to (3, 1, 0) m", "Red",
                             "extensions  used none\n", "MiB to render 1280x720: program"}) {
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

TEST_CASE("info reads clips that are too long to render whole", "[cli][info]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    std::string bytes = bytes_of(folder / "tiny.bin");
    const float last_key_s = 1e6f;
    std::memcpy(bytes.data() + 40, &last_key_s, sizeof last_key_s);
    write_file(folder / "tiny.bin", bytes);
    for (const char* const animation : {"auto", "none"}) {
        INFO(animation);
        const Outcome outcome =
            run_gridreel({"info", "tiny.gltf", "--json", "--fps", "1", "--animation", animation},
                         {.folder = folder.path()});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        CHECK(json::parse(outcome.out)["animations"][0]["frames"] == json{0, 1'000'000});
    }
    const Outcome render = run_gridreel({"render", "tiny.gltf", "--fps", "1"}, {.folder = folder.path()});
    CHECK(render.exit_code == 2);
    CHECK(render.err.find("--frames") != std::string::npos);
}
