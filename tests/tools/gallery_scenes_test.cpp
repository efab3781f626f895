#include "tools/gallery/glb_writer.h"
#include "tools/gallery/scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

using namespace gridreel::gallery;

namespace {

std::string glb_of(const Document& document) {
    std::ostringstream out;
    write_glb(document, out);
    return out.str();
}

std::string bundled(const SceneMaker& scene) {
    const std::string name(scene.name);
    const auto file = std::filesystem::path(GRIDREEL_GALLERY_FOLDER) / name / (name + ".glb");
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("the bundled scenes are what the generator writes, byte for byte", "[gallery]") {
    for (const SceneMaker& scene : scene_makers) {
        if (scene.place != Place::bundled) continue;
        INFO(scene.name);
        const std::string first = glb_of(scene.make(scene.usual_triangles));
        const bool repeats = first == glb_of(scene.make(scene.usual_triangles));
        CHECK(repeats);
        const bool is_bundled = first == bundled(scene);
        CHECK(is_bundled);
    }
}

TEST_CASE("a bundled scene takes at most 500 KB", "[gallery]") {
    for (const SceneMaker& scene : scene_makers) {
        if (scene.place != Place::bundled) continue;
        INFO(scene.name);
        const std::size_t size = bundled(scene).size();
        CHECK(size > 100'000);
        CHECK(size <= 500'000);
    }
}

TEST_CASE("from 2000 triangles on a scene has what was asked for within 2 %", "[gallery]") {
    for (const SceneMaker& scene : scene_makers)
        for (const std::size_t wanted : {2'000u, 3'001u, 7'777u, 20'000u, 80'000u}) {
            INFO(scene.name << " " << wanted);
            const double count = double(triangle_count(scene.make(wanted)));
            CHECK(std::abs(count - double(wanted)) <= 0.02 * double(wanted));
        }
}

TEST_CASE("a tiny request gives the smallest scene, a small one comes near", "[gallery]") {
    for (const SceneMaker& scene : scene_makers) {
        INFO(scene.name);
        const std::size_t smallest = triangle_count(scene.make(1));
        CHECK(smallest >= 1);
        CHECK(smallest <= 300);
        CHECK(triangle_count(scene.make(7)) <= 300);
        const double thousand = double(triangle_count(scene.make(1'000)));
        CHECK(std::abs(thousand - 1'000.0) <= 50.0);
    }
}

TEST_CASE("a million triangles need 32-bit indices, and count as asked for", "[gallery]") {
    const Document sheet = make_sheet(1'000'000);
    CHECK(std::abs(double(triangle_count(sheet)) - 1e6) <= 1e4);
    const bool has_wide = std::ranges::any_of(sheet.accessors, [](const Accessor& accessor) {
        return accessor.use == Use::indices && accessor.component == Component::u32;
    });
    CHECK(has_wide);
}
