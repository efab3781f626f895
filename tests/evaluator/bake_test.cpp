// The files that `gridreel bake` writes against the evaluator.

#include "sequences/bake.h"
#include "agreement.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

using namespace gridreel;

namespace {

const std::filesystem::path gallery = GRIDREEL_GALLERY;
const std::filesystem::path assets = GRIDREEL_SHARED_ASSETS;

struct Mesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::uvec3> triangles;
};

/// Only of what `write_ply` says it writes, with normals.
Mesh read_ply(const std::filesystem::path& file) {
    const std::string bytes = test::bytes_of(file);
    const auto count_of = [&](const std::string& element) {
        return std::stoul(bytes.substr(bytes.find("element " + element + " ") + 9 + element.size()));
    };
    const std::size_t vertices = count_of("vertex"), faces = count_of("face");
    const char* at = bytes.data() + bytes.find("end_header\n") + 11;
    REQUIRE(at + 24 * vertices + 13 * faces == bytes.data() + bytes.size());
    const auto take = [&](auto& value) {
        std::memcpy(&value, at, sizeof value);
        at += sizeof value;
    };
    Mesh mesh{.positions = std::vector<glm::vec3>(vertices),
              .normals = std::vector<glm::vec3>(vertices),
              .triangles = std::vector<glm::uvec3>(faces)};
    for (std::size_t i = 0; i < vertices; ++i) {
        take(mesh.positions[i]);
        take(mesh.normals[i]);
    }
    bool all_triangles = true;
    for (auto& triangle : mesh.triangles) {
        std::uint8_t corners = 0;
        take(corners);
        all_triangles = all_triangles && corners == 3;
        take(triangle);
    }
    CHECK(all_triangles);
    return mesh;
}

void check_bake(const std::filesystem::path& scene, const std::string& animation,
                const std::vector<std::size_t>& animations) {
    CAPTURE(scene);
    const test::ScratchFolder folder;
    const sequences::BakeJob job{.take = {.scene_file = scene,
                                          .animation = animation,
                                          .scene = {},
                                          .variant = {},
                                          .rate = {.numerator = 30000, .denominator = 1001},
                                          .frames = std::vector<sequences::Frame>{17, -3, 0, 5, 100000}},
                                 .output = sequences::FramePattern((folder / "####.ply").string()),
                                 .normals = true};
    const std::atomic<bool> stop = false;
    const sequences::BakeReports unheard{
        .warning = [](auto) {}, .note = [](auto) {}, .frame_done = [](auto, const auto&, auto, auto) {}};
    REQUIRE(sequences::bake(job, unheard, stop).frames == 5);

    const evaluator::Model model = evaluator::read_model(scene);
    const evaluator::Film film(model, animations, evaluator::default_scene(model.file));
    for (const sequences::Frame frame : *job.take.frames) {
        CAPTURE(frame);
        const Mesh mesh = read_ply(job.output.path(frame));
        test::check_frame(film.at(double(frame) * 1001.0 / 30000.0), mesh.positions, mesh.normals,
                          mesh.triangles);
    }
}

}  // namespace

TEST_CASE("baked files hold what the evaluator computes for the frame's time", "[evaluator][bake]") {
    check_bake(gallery / "walker/walker.glb", "auto", {0});
    check_bake(gallery / "marbles/marbles.glb", "none", {});
}

TEST_CASE("so do those of shared assets", "[evaluator][bake][assets]") {
    if (!std::filesystem::is_directory(assets)) {
        WARN("skipped: the shared assets are not there");
        return;
    }
    check_bake(assets / "characters/RobotExpressive.glb", "3", {3});
    check_bake(assets / "derived/CesiumMan_8influences.glb", "auto", {0});
    check_bake(assets / "khronos/AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf", "auto", {0});
    check_bake(assets / "khronos/InterpolationTest.glb", "all", {0, 1, 2, 3, 4, 5, 6, 7, 8});
    check_bake(assets / "khronos/MeshPrimitiveModes.gltf", "auto", {});
    check_bake(assets / "khronos/SimpleInstancing.glb", "auto", {});
}
