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

TEST_CASE("info says what a render would say", "[cli][info]") {
    const ScratchFolder folder;
    json scene = json::parse(bytes_of(write_tiny_scene(folder.path())));
    scene["materials"][0]["alphaMode"] = "BLEND";
    scene["images"] = {{{"uri", "data:image/png;base64,AAAA"}, {"name", "junk"}}};
    scene["textures"] = {{{"source", 0}}};
    scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    write_file(folder / "tiny.gltf", scene.dump());
    const json notes =
        json::parse(run_gridreel({"info", "tiny.gltf", "--json"}, {.folder = folder.path()}).out)["notes"];
    REQUIRE(notes.size() == 3);
    CHECK(notes[0].get<std::string>().starts_with("drawn white: image \"junk\""));
    CHECK(notes[1] == "material 0 \"Red\" has alpha mode BLEND: drawn opaque");
    CHECK(notes[2] == "no light in the scene: lit by the default dome and key light");
    const std::string page = run_gridreel({"info", "tiny.gltf"}, {.folder = folder.path()}).out;
    CHECK(page.find("note        material 0 \"Red\"") != page.npos);
}

TEST_CASE("info refuses a camera that no picture can be taken with, as render does", "[cli][info]") {
    const ScratchFolder folder;
    json scene = json::parse(bytes_of(write_tiny_scene(folder.path())));
    for (json& node : scene["nodes"])
        if (node.contains("camera")) node["scale"] = {0, 0, 0};
    write_file(folder / "tiny.gltf", scene.dump());
    const Outcome outcome = run_gridreel({"info", "tiny.gltf"}, {.folder = folder.path()});
    CHECK(outcome.exit_code == 3);
    CHECK(outcome.err.find("tiny: /nodes/") != std::string::npos);
    CHECK(outcome.err.find("\"Cam\": the camera's node has no orientation") != std::string::npos);
}

TEST_CASE("many materials are counted rather than listed", "[cli][info]") {
    const ScratchFolder folder;
    json scene = json::parse(bytes_of(write_tiny_scene(folder.path())));
    for (int i = 0; i < 300; ++i) scene["materials"].push_back({{"name", "Material " + std::to_string(i)}});
    write_file(folder / "tiny.gltf", scene.dump());
    const std::string page = run_gridreel({"info", "tiny.gltf"}, {.folder = folder.path()}).out;
    CHECK(page.find("materials   Red, Material 0, ") != page.npos);
    const auto more = page.find("and ", page.find("materials"));
    REQUIRE(more != page.npos);
    CHECK(std::stoi(page.substr(more + 4)) > 250);
    CHECK(page.find("Material 299") == page.npos);
}

TEST_CASE("names in a file do not steer the terminal", "[cli][info]") {
    const ScratchFolder folder;
    json scene = json::parse(bytes_of(write_tiny_scene(folder.path())));
    scene["materials"][0]["name"] = "evil\x1b[31m\a\nline";
    scene["materials"][0]["alphaMode"] = "BLEND";
    write_file(folder / "tiny.gltf", scene.dump());
    const std::string page = run_gridreel({"info", "tiny.gltf"}, {.folder = folder.path()}).out;
    CHECK(page.find("evil\\x1b[31m\\x07") != page.npos);
    const Outcome render =
        run_gridreel({"render", "tiny.gltf", "-f", "0", "-s", "8x8"}, {.folder = folder.path()});
    CHECK(render.err.find("evil\\x1b[31m\\x07") != std::string::npos);
    CHECK(page.find("\nline") == page.npos);
    CHECK(render.err.find("\nline") == std::string::npos);
    for (const std::string& text : {page, render.err}) {
        CHECK(text.find('\x1b') == text.npos);
        CHECK(text.find('\a') == text.npos);
    }
}
