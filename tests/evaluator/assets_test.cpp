// The program against the evaluator on real files. The shared ones are skipped by name where they are absent.

#include "agreement.h"
#include "anim/error.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

using namespace gridreel;

namespace {

const std::filesystem::path assets = GRIDREEL_SHARED_ASSETS;
const std::filesystem::path gallery = GRIDREEL_GALLERY;

/// Compressed meshes, which the evaluator does not decode; tests of the decoders compare them with the
/// uncompressed originals.
const std::set<std::string> compressed{
    "derived/Fox_gltfpack-cc.glb",
    "derived/MorphStressTest_gltfpack-c.glb",
    "derived/RobotExpressive_draco.glb",
    "derived/RobotExpressive_gltfpack-cc.glb",
    "khronos/CesiumMan-Draco/CesiumMan.gltf",
    "khronos/RiggedSimple-Draco/RiggedSimple.gltf",
};

/// Not glTF 2.0, by their own word or by what they hold.
const std::set<std::string> not_valid{
    "asset-generator/Compatibility/Compatibility_04.gltf",  // asks for glTF 2.1
    "asset-generator/negative/Mesh_PrimitiveRestart/Mesh_PrimitiveRestart_00.gltf",
    "asset-generator/negative/Mesh_PrimitiveRestart/Mesh_PrimitiveRestart_02.gltf",
};

/// Every model under a folder, sorted, as paths relative to it.
std::vector<std::string> models_under(const std::filesystem::path& folder) {
    std::vector<std::string> models;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const auto extension = entry.path().extension();
        if (extension == ".gltf" || extension == ".glb")
            models.push_back(std::filesystem::relative(entry.path(), folder).generic_string());
    }
    std::sort(models.begin(), models.end());
    return models;
}

}  // namespace

TEST_CASE("the bundled scenes agree with the evaluator vertex by vertex", "[evaluator]") {
    for (const auto& model : models_under(gallery)) DYNAMIC_SECTION(model) {
            CHECK(test::check_agreement(gallery / model) > 0);
        }
}

TEST_CASE("the shared assets agree with the evaluator vertex by vertex", "[evaluator][assets]") {
    if (!std::filesystem::is_directory(assets)) {
        WARN("skipped: the shared assets are not there");
        return;
    }
    for (const auto& model : models_under(assets)) {
        if (model.starts_with("invalid/") || compressed.contains(model) || not_valid.contains(model))
            continue;
        DYNAMIC_SECTION(model) {
            try {
                const std::size_t compared = test::check_agreement(assets / model);
                CHECK(compared > 0);
            } catch (const Error& error) {
                // What must load is the business of load_assets_test; a required extension may be missing.
                REQUIRE_THAT(error.where(), Catch::Matchers::Contains("/extensionsRequired"));
            }
        }
    }
}
