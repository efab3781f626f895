// Real files that are compressed, beside those they were made from. Skipped by name where the shared folder
// of assets is absent.

#include "anim/clip.h"
#include "anim/frame_geometry.h"
#include "anim/load.h"
#include "anim/pose.h"

#include <catch2/catch.hpp>
#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>

using namespace gridreel;

namespace {

const std::filesystem::path assets = GRIDREEL_SHARED_ASSETS;

struct Brothers {
    std::string plain, compressed;
    float step =
        0.0f;  ///< of quantization, with what it does to skins and keys: a fraction of the box's diagonal
};

const Brothers brothers[] = {
    {"khronos/CesiumMan.glb", "khronos/CesiumMan-Draco/CesiumMan.gltf", 1e-3f},
    {"khronos/RiggedSimple.glb", "khronos/RiggedSimple-Draco/RiggedSimple.gltf", 1e-3f},
    {"characters/RobotExpressive.glb", "derived/RobotExpressive_draco.glb", 1e-3f},
    {"characters/RobotExpressive.glb", "derived/RobotExpressive_gltfpack-cc.glb", 1e-3f},
    {"khronos/Fox.glb", "derived/Fox_gltfpack-cc.glb", 1e-3f},
    {"khronos/MorphStressTest.glb", "derived/MorphStressTest_gltfpack-c.glb", 1e-3f},
};

/// The corners of every triangle: the same cloud whatever the order of vertices and how they are shared.
std::vector<glm::vec3> corners_at(const anim::Scene& scene, const anim::Clip& clip,
                                  anim::FrameGeometry& geometry, double time_s) {
    anim::deform(scene, anim::pose(scene, clip, time_s), geometry);
    std::vector<glm::vec3> corners;
    for (const glm::uvec3& triangle : geometry.triangles)
        for (int k = 0; k < 3; ++k) corners.push_back(geometry.positions[triangle[k]]);
    return corners;
}

/// The greatest distance from a point of `from` to its nearest of `to`, both sorted into cells of that size;
/// infinite where none is in a neighbouring cell.
float reach(const std::vector<glm::vec3>& from, const std::vector<glm::vec3>& to, float cell) {
    std::map<std::array<int, 3>, std::vector<glm::vec3>> cells;
    const auto cell_of = [&](const glm::vec3& p) { return glm::ivec3(glm::floor(p / cell)); };
    for (const glm::vec3& p : to) {
        const glm::ivec3 c = cell_of(p);
        cells[{c.x, c.y, c.z}].push_back(p);
    }
    float farthest = 0.0f;
    for (const glm::vec3& p : from) {
        float nearest = std::numeric_limits<float>::infinity();
        const glm::ivec3 c = cell_of(p);
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z)
                    if (const auto found = cells.find({c.x + x, c.y + y, c.z + z}); found != cells.end())
                        for (const glm::vec3& q : found->second)
                            nearest = std::min(nearest, glm::distance(p, q));
        farthest = std::max(farthest, nearest);
    }
    return farthest;
}

}  // namespace

TEST_CASE("compressed characters move like those they were made from", "[draco][meshopt][assets]") {
    if (!std::filesystem::is_directory(assets)) {
        WARN("skipped: the shared assets are not there");
        return;
    }
    for (const auto& [plain_name, compressed_name, step] : brothers) {
        DYNAMIC_SECTION(compressed_name) {
            const auto plain = anim::load(assets / plain_name),
                       compressed = anim::load(assets / compressed_name);
            REQUIRE(compressed.animations.size() == plain.animations.size());
            const auto clip = anim::choose_clip(plain, "0"), twin = anim::choose_clip(compressed, "0");
            auto geometry = anim::lay_out(plain, clip), other = anim::lay_out(compressed, twin);
            for (const double time_s : {0.0, 0.1, 0.5, 1.0, 1.9}) {
                const auto expected = corners_at(plain, clip, geometry, time_s);
                const auto corners = corners_at(compressed, twin, other, time_s);
                // Encoders leave out triangles without area.
                CHECK(corners.size() <= expected.size());
                CHECK(corners.size() >= expected.size() * 99 / 100);

                glm::vec3 low = expected[0], high = low;
                for (const glm::vec3& p : expected) low = glm::min(low, p), high = glm::max(high, p);
                const float diagonal = glm::distance(low, high);
                INFO("at " << time_s << " s");
                CHECK(reach(corners, expected, 0.01f * diagonal) < step * diagonal);
                CHECK(reach(expected, corners, 0.01f * diagonal) < step * diagonal);
            }
        }
    }
}
