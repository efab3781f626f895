#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

using namespace gridreel::test;
using nlohmann::json;

namespace {

/// `tiny.gltf` with the variants "Red" (its own material) and "Blue", both unlit.
struct Shop {
    ScratchFolder folder;

    Shop() {
        write_tiny_scene(folder.path());
        json scene = json::parse(bytes_of(folder / "tiny.gltf"));
        scene["extensionsUsed"] = {"KHR_materials_variants", "KHR_materials_unlit"};
        scene["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "Red"}}, {{"name", "Blue"}}};
        json& materials = scene["materials"];
        materials[0]["extensions"]["KHR_materials_unlit"] = json::object();
        materials.push_back(materials[0]);
        materials[1]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.1, 1, 1};
        scene["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
            {{"material", 0}, {"variants", {0}}}, {{"material", 1}, {"variants", {1}}}};
        write_file(folder / "tiny.gltf", scene.dump());
    }

    [[nodiscard]] Outcome run(const std::vector<std::string>& arguments) const {
        return run_gridreel(arguments, {.folder = folder.path()});
    }

    /// Hash of the pixels of a small picture; the log's first line comes with it.
    [[nodiscard]] std::vector<json> render(const std::vector<std::string>& options) const {
        std::vector<std::string> arguments{"render", "tiny.gltf", "-s", "32x16",   "--spp", "1",
                                           "-f",     "0",         "-o", "out.png", "--log", "run.jsonl"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        std::filesystem::remove(folder / "run.jsonl");
        const Outcome outcome = run(arguments);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return read_log(folder / "run.jsonl");
    }
};

}  // namespace

TEST_CASE("a variant is rendered by name or number, and the log tells which", "[cli][variant]") {
    const Shop shop;
    const auto own = shop.render({});
    const auto red = shop.render({"--variant", "Red"});
    const auto blue = shop.render({"--variant", "Blue"});
    const auto second = shop.render({"--variant", "1"});
    CHECK(own[0]["options"]["variant"].is_null());
    CHECK(blue[0]["options"]["variant"] == "Blue");
    CHECK(own[1]["pixels_sha256"] == red[1]["pixels_sha256"]);
    CHECK(blue[1]["pixels_sha256"] != red[1]["pixels_sha256"]);
    CHECK(blue[1]["pixels_sha256"] == second[1]["pixels_sha256"]);

    write_file(shop.folder / "job.toml", "[render]\nvariant = \"Blue\"\n");
    CHECK(shop.render({"--config", "job.toml"})[1]["pixels_sha256"] == blue[1]["pixels_sha256"]);
}

TEST_CASE("a variant that the file does not have is wrong usage, and the others are listed",
          "[cli][variant]") {
    const Shop shop;
    for (const char* const command : {"render", "info", "bench"}) {
        for (const char* const variant : {"Green", "2"}) {
            const Outcome outcome = shop.run({command, "tiny.gltf", "--variant", variant});
            INFO(outcome.err);
            CHECK(outcome.exit_code == 2);
            CHECK(outcome.err.find("0 \"Red\", 1 \"Blue\"") != std::string::npos);
        }
    }
    const Outcome baked = shop.run({"bake", "tiny.gltf", "--variant", "Blue"});
    CHECK(baked.exit_code == 2);  // materials do not matter to it
}

TEST_CASE("info lists the variants and which is shown", "[cli][variant]") {
    const Shop shop;
    const auto info = [&](const std::vector<std::string>& options) {
        std::vector<std::string> arguments{"info", "tiny.gltf"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return shop.run(arguments).out;
    };
    CHECK(json::parse(info({"--json"}))["variants"] == json{"Red", "Blue"});
    CHECK(json::parse(info({"--json"}))["variant"].is_null());
    CHECK(json::parse(info({"--json", "--variant", "Blue"}))["variant"] == 1);
    CHECK(info({"--variant", "Blue"}).find("1 Blue, shown\n") != std::string::npos);
    CHECK(info({}).find("0 Red\n") != std::string::npos);
}
