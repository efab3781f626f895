#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

using namespace gridreel::test;
using nlohmann::json;

namespace {

template <class T>
std::vector<T> values(const std::string& bytes, std::size_t offset, std::size_t count) {
    std::vector<T> result(count);
    REQUIRE(offset + count * sizeof(T) <= bytes.size());
    std::memcpy(result.data(), bytes.data() + offset, count * sizeof(T));
    return result;
}

std::size_t header_end(const std::string& ply) {
    const std::string end = "end_header\n";
    REQUIRE(ply.find(end) != std::string::npos);
    return ply.find(end) + end.size();
}

Outcome bake_tiny(const ScratchFolder& folder, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"bake", "tiny.gltf", "-o", "####.ply"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    Outcome outcome = run_gridreel(arguments, {.folder = folder.path()});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
}

std::vector<int> baked_frames(const ScratchFolder& folder) {
    std::vector<int> frames;
    const json cameras = json::parse(bytes_of(folder / "tiny.cameras.json"));
    for (const json& view : cameras["frames"]) frames.push_back(view["frame"]);
    return frames;
}

}  // namespace

TEST_CASE("baked meshes hold the world-space triangles of their time", "[cli][bake]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome =
        run_gridreel({"bake", "tiny.gltf", "-o", "out/####.ply", "--fps", "4"}, {.folder = folder.path()});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    for (int frame = 0; frame <= 4; ++frame) {
        const std::string ply = bytes_of(folder / ("out/000" + std::to_string(frame) + ".ply"));
        CHECK(ply.starts_with("ply\nformat binary_little_endian 1.0\nelement vertex 6\n"));
        const std::size_t data = header_end(ply);
        const float x = 2.0f * float(frame) / 4.0f;  // two metres in a second
        CHECK(values<float>(ply, data, 18) ==
              std::vector<float>{x, 0, 0, x + 1, 0, 0, x, 1, 0, 0, 0, -1, 1, 0, -1, 0, 1, -1});
        CHECK(ply[data + 72] == 3);
        CHECK(values<std::uint32_t>(ply, data + 73, 3) == std::vector<std::uint32_t>{0, 1, 2});
        CHECK(values<std::uint32_t>(ply, data + 86, 3) == std::vector<std::uint32_t>{3, 4, 5});
        CHECK(ply.size() == data + 72 + 2 * 13);
    }
    CHECK_FALSE(std::filesystem::exists(folder / "out/0005.ply"));
}

TEST_CASE("baking writes down the render camera", "[cli][bake]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    REQUIRE(run_gridreel({"bake", "tiny.gltf", "-o", "out/####.ply", "-f", "1-2", "--fps", "4", "-s", "640x"},
                         {.folder = folder.path()})
                .exit_code == 0);
    const json cameras = json::parse(bytes_of(folder / "out/tiny.cameras.json"));
    CHECK(cameras["schema"] == "gridreel.cameras/1");
    CHECK(cameras["camera"] == "Cam");
    REQUIRE(cameras["frames"].size() == 2);
    const json& second = cameras["frames"][1];
    CHECK(second["frame"] == 2);
    CHECK(second["time_s"] == 0.5);
    CHECK(second["kind"] == "perspective");
    CHECK(second["eye"] == json{1.0, 0.5, 5.0});
    CHECK(second["forward"] == json{0.0, 0.0, -1.0});
    CHECK(second["up"] == json{0.0, 1.0, 0.0});
    CHECK(second["fov_y_rad"].get<double>() == Approx(0.8).margin(1e-6));
    CHECK(second["aspect"].get<double>() == Approx(2.0));
}

TEST_CASE("normals are baked on request", "[cli][bake]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    REQUIRE(
        run_gridreel({"bake", "tiny.gltf", "-o", "t.ply", "-f", "0", "--normals"}, {.folder = folder.path()})
            .exit_code == 0);
    const std::string ply = bytes_of(folder / "t.ply");
    CHECK(ply.find("property float nz\n") != std::string::npos);
    CHECK(ply.size() == header_end(ply) + 6 * 24 + 2 * 13);
}

TEST_CASE("a scene without triangles and camera is seen from a finite place", "[cli][bake]") {
    const ScratchFolder folder;
    write_file(folder / "empty.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0,
                                          "nodes": [{"name": "Nothing"}]})");
    const Outcome outcome = run_gridreel({"bake", "empty.gltf", "-o", "t.ply"}, {.folder = folder.path()});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const json cameras = json::parse(bytes_of(folder / "empty.cameras.json"));
    const json& view = cameras["frames"][0];
    for (const json& coordinate : view["eye"]) CHECK(coordinate.is_number());
    CHECK(view["aspect"].get<double>() == Approx(16.0 / 9.0));
}

TEST_CASE("the height for a sliver of a camera stays within the largest picture", "[cli][bake]") {
    const ScratchFolder folder;
    std::string gltf = bytes_of(write_tiny_scene(folder.path()));
    const std::string stated = R"("aspectRatio": 2.0)";
    gltf.replace(gltf.find(stated), stated.size(), R"("aspectRatio": 1e-9)");
    write_file(folder / "tiny.gltf", gltf);
    const Outcome outcome =
        run_gridreel({"bake", "tiny.gltf", "-o", "t.ply", "-f", "0", "-s", "64x"}, {.folder = folder.path()});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const json cameras = json::parse(bytes_of(folder / "tiny.cameras.json"));
    CHECK(cameras["frames"][0]["aspect"].get<double>() == Approx(64.0 / 65535.0));
}

TEST_CASE("parts of a bake make the camera file of the whole", "[cli][bake]") {
    const ScratchFolder whole, parts;
    for (const ScratchFolder* folder : {&whole, &parts}) write_tiny_scene(folder->path());
    bake_tiny(whole, {"-f", "0-6"});
    bake_tiny(parts, {"-f", "5-6"});
    bake_tiny(parts, {"-f", "0-3"});
    const Outcome last = bake_tiny(parts, {"-f", "6,4,2"});
    CHECK(last.err.find("written anew") == std::string::npos);
    CHECK(bytes_of(parts / "tiny.cameras.json") == bytes_of(whole / "tiny.cameras.json"));
}

TEST_CASE("frames baked again replace theirs in the camera file", "[cli][bake]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    bake_tiny(folder, {"-f", "0-2"});
    json cameras = json::parse(bytes_of(folder / "tiny.cameras.json"));
    for (json& view : cameras["frames"]) view["eye"] = {9, 9, 9};
    write_file(folder / "tiny.cameras.json", cameras.dump());
    bake_tiny(folder, {"-f", "1"});
    cameras = json::parse(bytes_of(folder / "tiny.cameras.json"));
    REQUIRE(baked_frames(folder) == std::vector<int>{0, 1, 2});
    CHECK(cameras["frames"][0]["eye"] == json{9, 9, 9});
    CHECK(cameras["frames"][1]["eye"] == json{1.0, 0.5, 5.0});
    CHECK(cameras["frames"][2]["eye"] == json{9, 9, 9});
}

TEST_CASE("a camera file of another bake is replaced as a whole, with a note", "[cli][bake]") {
    struct Other {
        const char* differs;
        std::vector<std::string> options;
    };
    for (const auto& [differs, options] :
         {Other{"fps", {"--fps", "30"}}, Other{"animations", {"--animation", "none"}},
          Other{"camera", {"--camera", "fit"}}, Other{"aspect", {"-s", "100x100"}}}) {
        INFO(differs);
        const ScratchFolder folder;
        write_tiny_scene(folder.path());
        bake_tiny(folder, {"-f", "0-2"});
        std::vector<std::string> again{"-f", "7"};
        again.insert(again.end(), options.begin(), options.end());
        const Outcome outcome = bake_tiny(folder, again);
        CHECK(outcome.err.find("tiny.cameras.json is written anew: it is of another bake (\"" +
                               std::string(differs) + "\")") != std::string::npos);
        CHECK(baked_frames(folder) == std::vector<int>{7});
    }
}

TEST_CASE("a camera file of another scene is replaced as a whole, with a note", "[cli][bake]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    bake_tiny(folder, {"-f", "0-2"});
    write_file(folder / "tiny.gltf", bytes_of(folder / "tiny.gltf") + "\n");
    const Outcome outcome = bake_tiny(folder, {"-f", "7"});
    CHECK(outcome.err.find("scene_sha256") != std::string::npos);
    CHECK(baked_frames(folder) == std::vector<int>{7});
}

TEST_CASE("what is no camera file is replaced, with a note", "[cli][bake]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const auto note_about = [&](const std::string& content) {
        write_file(folder / "tiny.cameras.json", content);
        const Outcome outcome = bake_tiny(folder, {"-f", "7"});
        CHECK(baked_frames(folder) == std::vector<int>{7});
        return outcome.err;
    };
    bake_tiny(folder, {"-f", "0"});
    json damaged = json::parse(bytes_of(folder / "tiny.cameras.json"));
    damaged["frames"] = {{{"frame", "first"}}};
    CHECK(note_about(damaged.dump()).find("its frames are damaged") != std::string::npos);
    for (const char* const content : {"", "{", "[]", "null", R"({"schema": "other/1", "frames": []})"}) {
        INFO(content);
        CHECK(note_about(content).find("it is no camera file") != std::string::npos);
    }
}

TEST_CASE("what is baked does not depend on the number of threads", "[cli][bake]") {
    const ScratchFolder one, several;
    for (const ScratchFolder* folder : {&one, &several}) write_tiny_scene(folder->path());
    bake_tiny(one, {"-f", "0-3", "-j", "1"});
    bake_tiny(several, {"-f", "0-3", "--threads", "3"});
    CHECK(one.names() == several.names());
    for (const std::string& name : one.names()) CHECK(bytes_of(one / name) == bytes_of(several / name));
    CHECK(run_gridreel({"bake", "tiny.gltf", "-j", "0"}, {.folder = one.path()}).exit_code == 2);
}
