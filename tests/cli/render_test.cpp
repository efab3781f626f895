#include "sequences/fingerprint.h"
#include "tests/cli/run_command.h"
#include "tests/cli/tiny_scene.h"
#include "tests/sequences/scratch_folder.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <vector>

using namespace gridreel::test;
using Names = std::vector<std::string>;

namespace {

/// A folder with the tiny scene, in which the command runs.
struct Workshop {
    ScratchFolder folder;

    Workshop() { write_tiny_scene(folder.path()); }

    Outcome run(std::vector<std::string> arguments) const {
        return run_gridreel(arguments, {.folder = folder.path()});
    }

    /// `render tiny.gltf`, small.
    Outcome render(const Names& more) const {
        Names arguments{"render", "tiny.gltf", "-s", "48x24", "--spp", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
};

Names hashes_of(const std::vector<nlohmann::json>& frames) {
    Names hashes;
    for (const auto& frame : frames) hashes.push_back(frame.at("pixels_sha256"));
    return hashes;
}

/// The stored values of a file, as they lie in it.
std::vector<std::byte> stored_pixels(const std::filesystem::path& file) {
    OIIO::ImageSpec as_stored;
    as_stored.attribute("oiio:UnassociatedAlpha", 1);
    const auto in = OIIO::ImageInput::open(file.string(), &as_stored);
    REQUIRE(in);
    std::vector<std::byte> pixels(in->spec().image_bytes(true));
    REQUIRE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::UNKNOWN, pixels.data()));
    return pixels;
}

bool has_control_characters(const std::string& text) {
    return std::any_of(text.begin(), text.end(),
                       [](unsigned char c) { return (c < 32 && c != '\n') || c == 127; });
}

}  // namespace

TEST_CASE("a whole clip becomes frames, a log and a table", "[cli][render]") {
    const Workshop workshop;
    const Outcome outcome = workshop.render({"-o", "out/t.####.exr", "--fps", "4"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);

    // One second at 4 frames a second, both ends included.
    Names names;
    for (const auto& entry : std::filesystem::directory_iterator(workshop.folder / "out")) {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    CHECK(names == Names{"t.0000.exr", "t.0001.exr", "t.0002.exr", "t.0003.exr", "t.0004.exr", "t.jsonl"});

    for (const char* row :
         {"animate", "rebuild", "trace", "shade", "write", "total", "rebuild share", "out/t.####.exr"}) {
        INFO(row);
        CHECK(outcome.out.find(row) != std::string::npos);
    }
    CHECK_FALSE(has_control_characters(outcome.out));
    CHECK_FALSE(has_control_characters(outcome.err));
    CHECK(outcome.err.find("5/5 frame 4 -> out/t.0004.exr") != std::string::npos);
}

TEST_CASE("the log has a line for the run and one for each frame", "[cli][render]") {
    const Workshop workshop;
    REQUIRE(workshop.render({"-o", "out/t.####.exr", "--fps", "4", "-j", "2"}).exit_code == 0);
    const auto lines = read_log(workshop.folder / "out/t.jsonl");
    REQUIRE(lines.size() == 6);
    CHECK(lines[0]["schema"] == "gridreel.run/1");
    CHECK(lines[0]["threads"] == 2);
    CHECK(lines[0]["animations"] == nlohmann::json{"Slide"});
    CHECK(lines[0]["scene"]["sha256"] == gridreel::sequences::scene_sha256(workshop.folder / "tiny.gltf"));
    for (std::size_t i = 0; i < 5; ++i) {
        const auto& line = lines[i + 1];
        INFO(line);
        CHECK(line["schema"] == "gridreel.frame/1");
        CHECK(line["frame"] == i);
        CHECK(line["time_s"] == double(i) / 4.0);
        CHECK(line["triangles"]["moving"] == 1);
        CHECK(line["triangles"]["still"] == 1);
        CHECK(line["grid"]["cells"].size() == 3);
        CHECK(line["grid"]["references"] >= 2);
        for (const char* phase : {"animate", "trace", "shade", "write", "total"})
            CHECK(line["ms"][phase] >= 0.0);
        for (const char* part : {"bounds", "count", "scatter"}) CHECK(line["ms"]["rebuild"][part] >= 0.0);
        CHECK(line["rays"]["primary"] == 48 * 24);
        CHECK(line["rays"].contains("shadow"));
        CHECK(line["rays"].contains("secondary"));
        CHECK(line["peak_bytes"] > 1'000'000);
        CHECK(line["file"] == "out/t.000" + std::to_string(i) + ".exr");
    }
    // The triangle moves, so no two frames look alike.
    const Names hashes = hashes_of(frames_of(workshop.folder / "out/t.jsonl"));
    CHECK(std::set<std::string>(hashes.begin(), hashes.end()).size() == 5);
}

TEST_CASE("the hash in the log is that of the pixels in the file", "[cli][render]") {
    const Workshop workshop;
    for (const std::string extension : {"exr", "png"}) {
        REQUIRE(workshop.render({"-o", extension + "/t.####." + extension, "-f", "3"}).exit_code == 0);
        const auto frames = frames_of(workshop.folder / (extension + "/t.jsonl"));
        REQUIRE(frames.size() == 1);
        const auto pixels = stored_pixels(workshop.folder / (extension + "/t.0003." + extension));
        CHECK(frames[0]["pixels_sha256"] == gridreel::sequences::sha256_hex(pixels));
    }
}

TEST_CASE("pixels do not depend on the number of threads", "[cli][render]") {
    const Workshop workshop;
    REQUIRE(workshop.render({"-o", "one/t.####.exr", "--fps", "4", "-j", "1"}).exit_code == 0);
    REQUIRE(workshop.render({"-o", "four/t.####.exr", "--fps", "4", "-j", "4"}).exit_code == 0);
    const Names one = hashes_of(frames_of(workshop.folder / "one/t.jsonl"));
    CHECK(one.size() == 5);
    CHECK(hashes_of(frames_of(workshop.folder / "four/t.jsonl")) == one);
    CHECK(bytes_of(workshop.folder / "four/t.0002.exr") == bytes_of(workshop.folder / "one/t.0002.exr"));
}

TEST_CASE("a frame alone equals the same frame in a run", "[cli][render]") {
    const Workshop workshop;
    REQUIRE(workshop.render({"-o", "run/t.####.exr"}).exit_code == 0);
    REQUIRE(workshop.render({"-o", "alone/t.####.exr", "-f", "17"}).exit_code == 0);
    CHECK(bytes_of(workshop.folder / "alone/t.0017.exr") == bytes_of(workshop.folder / "run/t.0017.exr"));
    CHECK(frames_of(workshop.folder / "run/t.jsonl").size() == 25);
}

TEST_CASE("frames come in the order asked for", "[cli][render]") {
    const Workshop workshop;
    REQUIRE(workshop.render({"-o", "out/t.####.png", "-f", "9,2-4,-5--4,2"}).exit_code == 0);
    std::vector<int> order;
    for (const auto& frame : frames_of(workshop.folder / "out/t.jsonl")) order.push_back(frame["frame"]);
    CHECK(order == std::vector<int>{9, 2, 3, 4, -5, -4});
    CHECK(std::filesystem::exists(workshop.folder / "out/t.-0005.png"));
}

TEST_CASE("a second run overwrites the frames and appends to the log", "[cli][render]") {
    const Workshop workshop;
    REQUIRE(workshop.render({"-o", "out/t.####.exr", "-f", "0-2"}).exit_code == 0);
    const std::string before = bytes_of(workshop.folder / "out/t.0001.exr");
    REQUIRE(workshop.render({"-o", "out/t.####.exr", "-f", "1", "--exposure", "-1"}).exit_code == 0);
    CHECK(bytes_of(workshop.folder / "out/t.0001.exr") != before);
    const auto lines = read_log(workshop.folder / "out/t.jsonl");
    REQUIRE(lines.size() == 6);
    CHECK(lines[4]["schema"] == "gridreel.run/1");
    CHECK(lines[4]["options"]["exposure"] == -1.0);
    CHECK(lines[5]["frame"] == 1);
}

TEST_CASE("without an output the frames go to a folder of their own", "[cli][render]") {
    const Workshop workshop;
    REQUIRE(workshop.render({"-f", "0"}).exit_code == 0);
    CHECK(std::filesystem::exists(workshop.folder / "frames/tiny.0000.exr"));
    CHECK(std::filesystem::exists(workshop.folder / "frames/tiny.jsonl"));
}

TEST_CASE("extra channels, depth and size reach the file", "[cli][render]") {
    const Workshop workshop;
    REQUIRE(workshop
                .run({"render", "tiny.gltf", "-s", "64x", "--spp", "1", "-f", "0", "-o", "t.exr", "--aov",
                      "z,n", "--depth", "float", "--compression", "piz", "--log", "logs/t.jsonl"})
                .exit_code == 0);
    const auto in = OIIO::ImageInput::open((workshop.folder / "t.exr").string());
    REQUIRE(in);
    CHECK(in->spec().width == 64);
    CHECK(in->spec().height == 32);  // the camera's aspect is 2
    CHECK(in->spec().format == OIIO::TypeDesc::FLOAT);
    CHECK(in->spec().get_string_attribute("compression") == "piz");
    CHECK(in->spec().channelnames == Names{"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"});
    CHECK(frames_of(workshop.folder / "logs/t.jsonl").size() == 1);
}

TEST_CASE("quiet means no word unless something is wrong", "[cli][render]") {
    const Workshop workshop;
    for (const Names& flag : {Names{"-q"}, Names{"-q", "--progress", "always"}}) {
        Names more{"-f", "0-1"};
        more.insert(more.end(), flag.begin(), flag.end());
        const Outcome outcome = workshop.render(more);
        CHECK(outcome.exit_code == 0);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.empty());
    }
    const Outcome before_command = workshop.run({"-q", "render", "tiny.gltf", "-s", "16x8", "-f", "0"});
    CHECK(before_command.exit_code == 0);
    CHECK(before_command.err.empty());
    const Outcome wrong = workshop.run({"-q", "render", "none.glb"});
    CHECK(wrong.exit_code == 3);
    CHECK_FALSE(wrong.err.empty());
}

TEST_CASE("of two lists of frames or sizes the later one wins", "[cli][render]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    const Outcome outcome = run_gridreel({"render", "tiny.gltf", "-f", "0-3", "-s", "64x32", "--frames", "1",
                                          "--size", "16x8", "-o", "t.####.exr"},
                                         {.folder = folder.path()});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto lines = read_log(folder / "t.jsonl");
    REQUIRE(lines.size() == 2);
    CHECK(lines[0]["options"]["size"] == nlohmann::json{16, 8});
    CHECK(lines[1]["frame"] == 1);
}

TEST_CASE("a damaged texture is a note with its name, and the rest is rendered", "[cli][render]") {
    const ScratchFolder folder;
    write_tiny_scene(folder.path());
    auto scene = nlohmann::json::parse(bytes_of(folder / "tiny.gltf"));
    scene["images"] = {{{"name", "Bricks"}, {"uri", "data:image/png;base64,iVBORw0KGgo="}}};
    scene["textures"] = {{{"source", 0}}};
    scene["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    write_file(folder / "tiny.gltf", scene.dump());
    const Outcome outcome = run_gridreel({"render", "tiny.gltf", "-s", "32x16", "-f", "0", "-o", "out.png"},
                                         {.folder = folder.path()});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.find("drawn white: image \"Bricks\"") != std::string::npos);
}
