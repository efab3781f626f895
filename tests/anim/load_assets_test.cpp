// Real files. Skipped by name where the shared folder of assets is absent.

#include "anim/error.h"
#include "anim/gltf/document.h"
#include "gltf_builder.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace gridreel;
using Catch::Matchers::Contains;

namespace {

const std::filesystem::path assets = GRIDREEL_SHARED_ASSETS;

bool assets_are_absent() {
    if (std::filesystem::is_directory(assets)) return false;
    WARN("skipped: the shared assets are not there");
    return true;
}

/// Every model under a folder, in a fixed order, as paths relative to the assets.
std::vector<std::string> models_under(const std::string& folder) {
    std::vector<std::string> models;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets / folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".gltf" || extension == ".glb")
            models.push_back(std::filesystem::relative(entry.path(), assets).generic_string());
    }
    std::sort(models.begin(), models.end());
    return models;
}

/// What a file must be refused for.
const std::map<std::string, std::string> refused_for{
    {"asset-generator/Compatibility/Compatibility_04.gltf", "glTF 2.1"},
};

template <class Items>
bool all_below(const Items& items, std::size_t limit) {
    return std::all_of(items.begin(), items.end(), [&](auto i) { return i < limit; });
}

/// How many objects there are that a channel on `path` could drive.
std::size_t count_of(const anim::Scene& scene, anim::ChannelPath path) {
    if (path == anim::ChannelPath::camera) return scene.cameras.size();
    if (path == anim::ChannelPath::light) return scene.lights.size();
    return path == anim::ChannelPath::material ? scene.materials.size() : scene.nodes.size();
}

/// Everything the header of `Scene` promises about indices and sizes.
void check_promises(const anim::Scene& scene) {
    REQUIRE_FALSE(scene.scenes.empty());
    CHECK(scene.default_scene < scene.scenes.size());
    for (const auto& roots : scene.scenes) CHECK(all_below(roots, scene.nodes.size()));
    for (const auto& node : scene.nodes) {
        CHECK(all_below(node.children, scene.nodes.size()));
        CHECK(node.mesh.value_or(0) < std::max<std::size_t>(scene.meshes.size(), 1));
        CHECK(node.skin.value_or(0) < std::max<std::size_t>(scene.skins.size(), 1));
        CHECK((node.weights.empty() || node.weights.size() == scene.meshes[*node.mesh].weights.size()));
    }
    for (const auto& skin : scene.skins) {
        CHECK(all_below(skin.joints, scene.nodes.size()));
        CHECK(skin.inverse_bind.size() == skin.joints.size());
    }
    for (const auto& mesh : scene.meshes) {
        for (const auto& primitive : mesh.primitives) {
            const std::size_t count = primitive.positions.size();
            const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
            CHECK(
                std::all_of(primitive.triangles.begin(), primitive.triangles.end(),
                            [&](const glm::uvec3& t) { return t.x < count && t.y < count && t.z < count; }));
            CHECK((fits(primitive.normals.size()) && fits(primitive.tangents.size())));
            CHECK((fits(primitive.colors.size()) && fits(primitive.texcoords[0].size())));
            CHECK(primitive.targets.size() == mesh.weights.size());
            const auto& influences = primitive.influences;
            CHECK(fits(influences.per_vertex == 0 ? 0 : influences.joints.size() / influences.per_vertex));
            CHECK(influences.weights.size() == influences.joints.size());
        }
    }
    for (const auto& animation : scene.animations) {
        for (const auto& channel : animation.channels) {
            CHECK(channel.object < count_of(scene, channel.path));
            REQUIRE(channel.sampler < animation.samplers.size());
        }
        for (const auto& sampler : animation.samplers) {
            const std::size_t per_key = sampler.interpolation == anim::Interpolation::cubic_spline ? 3 : 1;
            CHECK(sampler.values.size() == sampler.times_s.size() * per_key * sampler.width);
            CHECK_FALSE(sampler.times_s.empty());
        }
    }
}

}  // namespace

TEST_CASE("every shared asset loads or is refused for the extension it requires", "[load][assets]") {
    if (assets_are_absent()) return;
    for (const auto* const folder :
         {"asset-generator", "bart", "blender-io", "characters", "derived", "khronos", "scenes"}) {
        for (const auto& model : models_under(folder)) {
            if (model.starts_with("asset-generator/negative")) continue;
            DYNAMIC_SECTION(model) {
                if (const auto refused = refused_for.find(model); refused != refused_for.end())
                    CHECK_THROWS_WITH(anim::load(assets / model), Contains(refused->second));
                else
                    check_promises(anim::load(assets / model));
            }
        }
    }
}

TEST_CASE("known characters have the bones, clips and triangles they are known for", "[load][assets]") {
    if (assets_are_absent()) return;
    const auto triangles = [](const anim::Scene& scene) {
        std::size_t count = 0;
        for (const auto& mesh : scene.meshes)
            for (const auto& primitive : mesh.primitives) count += primitive.triangles.size();
        return count;
    };

    const auto fox = anim::load(assets / "khronos/Fox.glb");
    CHECK(triangles(fox) == 576);
    CHECK(fox.skins.at(0).joints.size() == 24);
    CHECK(fox.animations.size() == 3);
    CHECK(fox.meshes[0].primitives[0].normals.empty());
    CHECK(fox.images.at(0).encoded.size() > 1000);

    const auto man = anim::load(assets / "khronos/CesiumMan.glb");
    CHECK(triangles(man) == 4672);
    CHECK(man.skins.at(0).joints.size() == 19);

    const auto spread = anim::load(assets / "derived/CesiumMan_8influences.glb");
    CHECK(spread.meshes[0].primitives[0].influences.per_vertex == 8);

    const auto robot = anim::load(assets / "characters/RobotExpressive.glb");
    CHECK(triangles(robot) == 3237);
    CHECK(robot.animations.size() == 14);
}

TEST_CASE("quantized characters are those of the original, nearly", "[load][assets]") {
    if (assets_are_absent()) return;
    const auto cube = anim::load(assets / "khronos/AnimatedMorphCube.glb");
    const auto quantized = anim::load(assets / "khronos/AnimatedMorphCube-Quantized/AnimatedMorphCube.gltf");
    CHECK(quantized.meshes.at(0).weights.size() == cube.meshes.at(0).weights.size());
    const auto& normals = quantized.meshes[0].primitives.at(0).normals;
    REQUIRE(normals.size() == cube.meshes[0].primitives.at(0).normals.size());
    for (const auto& normal : normals)
        CHECK(std::hypot(normal.x, normal.y, normal.z) == Approx(1.0).margin(0.02));
}

TEST_CASE("malformed files are refused with a place and a remedy", "[load][assets]") {
    if (assets_are_absent()) return;
    for (const auto& model : models_under("invalid")) {
        DYNAMIC_SECTION(model) {
            // The validator finds nothing wrong with this one; it is here because it crashed a reader.
            if (model.ends_with("zero-sized-bin-chunk-issue-440.glb")) {
                check_promises(anim::load(assets / model));
                continue;
            }
            try {
                static_cast<void>(anim::load(assets / model));
                FAIL("it loaded");
            } catch (const Error& error) {
                const auto name = std::filesystem::path(model).filename().string();
                CHECK_THAT(error.where(), Contains(name));
                CHECK_FALSE(error.remedy().empty());
            }
        }
    }
}

TEST_CASE("the asset generator's negative models are refused or left empty", "[load][assets]") {
    if (assets_are_absent()) return;
    const auto folder = assets / "asset-generator/negative";
    CHECK_THROWS_WITH(anim::load(folder / "Mesh_PrimitiveRestart/Mesh_PrimitiveRestart_00.gltf"),
                      Contains("/meshes/0/primitives/0/indices") && Contains("restart"));
    CHECK_THROWS_WITH(anim::load(folder / "Mesh_PrimitiveRestart/Mesh_PrimitiveRestart_02.gltf"),
                      Contains("restart"));

    const auto scene = anim::load(folder / "Mesh_NoPosition/Mesh_NoPosition_00.gltf");
    CHECK(scene.meshes.at(0).primitives.empty());
    CHECK_THAT(test::warning_at(scene, "/meshes/0/primitives/0"), Contains("no positions"));
}

TEST_CASE("real files cut short are refused", "[load][assets]") {
    if (assets_are_absent()) return;
    for (const auto* const model : {"khronos/RiggedSimple.glb", "khronos/AnimatedMorphCube.glb",
                                    "khronos/SimpleSparseAccessor.gltf", "scenes/box_sparse.glb"}) {
        DYNAMIC_SECTION(model) {
            const auto whole = anim::gltf::read_whole_file(assets / model);
            const std::size_t step = std::max<std::size_t>(1, whole.size() / 200);
            // The last bytes of a .gltf may be blank.
            for (std::size_t length = 0; length + 16 < whole.size(); length += step) {
                const std::vector<std::byte> cut(whole.begin(),
                                                 whole.begin() + static_cast<std::ptrdiff_t>(length));
                REQUIRE_FALSE(test::refusal_of(cut, assets / model).message.empty());
            }
        }
    }
}
