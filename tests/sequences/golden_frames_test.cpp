// Small frames of the gallery against stored ones. After a change that is meant to show, look at the new
// pictures and store them: GRIDREEL_STORE_GOLDEN=1 tools/test -R golden

#include "anim/clip.h"
#include "anim/load.h"
#include "engine/frame_renderer.h"
#include "sequences/image_writer.h"
#include "sequences/picture.h"
#include "traversal/simd_target.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace gridreel::sequences {
namespace {

const std::filesystem::path project = GRIDREEL_PROJECT_FOLDER;
const ImageSettings png{.format = ImageFormat::png};

struct Golden {
    std::string scene;
    double time_s;
};

const std::vector<Golden> goldens{{"marbles", 1.25}, {"walker", 0.5}, {"sheet", 1.0}, {"stadium", 2.0}};

anim::Scene gallery_scene(const std::string& name) {
    return anim::load(project / "sequences/gallery" / name / (name + ".glb"));
}

Picture render(const anim::Scene& scene, double time_s) {
    engine::RenderSettings settings;
    settings.width = 160;
    settings.height = 90;
    engine::FrameRenderer renderer(scene, anim::choose_clip(scene), settings);
    engine::Film film;
    renderer.render(time_s, film);
    Picture picture;
    store(film, png, picture);
    return picture;
}

std::vector<std::byte> read_pixels(const std::filesystem::path& file) {
    const auto in = OIIO::ImageInput::open(file.string());
    REQUIRE(in);
    std::vector<std::byte> pixels(in->spec().image_bytes());
    REQUIRE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, pixels.data()));
    return pixels;
}

struct Difference {
    std::size_t wrong_pixels = 0;  ///< with a channel more than two levels off
    int worst = 0;                 ///< levels
};

Difference difference(const std::vector<std::byte>& expected, const Picture& actual) {
    REQUIRE(expected.size() == actual.pixels.size());
    const std::size_t channels = actual.channels.size();
    Difference found;
    for (std::size_t pixel = 0; pixel < expected.size(); pixel += channels) {
        int worst = 0;
        for (std::size_t i = pixel; i < pixel + channels; ++i) {
            worst = std::max(
                worst, std::abs(std::to_integer<int>(expected[i]) - std::to_integer<int>(actual.pixels[i])));
        }
        found.wrong_pixels += worst > 2;
        found.worst = std::max(found.worst, worst);
    }
    return found;
}

/// Machines round differently where their instructions do: a few pixels on silhouettes may change.
bool acceptable(const Difference& found) {
    return found.wrong_pixels <= 3;
}

}  // namespace

TEST_CASE("gallery frames look as they did, on every SIMD target", "[golden]") {
    for (const Golden& golden : goldens) {
        INFO(golden.scene);
        const anim::Scene scene = gallery_scene(golden.scene);
        const std::filesystem::path file = project / "tests/golden" / (golden.scene + ".png");
        if (std::getenv("GRIDREEL_STORE_GOLDEN") != nullptr)
            write_image(render(scene, golden.time_s), png, file);
        const std::vector<std::byte> expected = read_pixels(file);
        for (const std::string_view target : traversal::simd_targets()) {
            REQUIRE(traversal::limit_simd_target(target));
            const Difference found = difference(expected, render(scene, golden.time_s));
            traversal::limit_simd_target("");
            INFO(target << ": " << found.wrong_pixels << " pixels differ, by up to " << found.worst
                        << " levels");
            CHECK(acceptable(found));
        }
    }
}

TEST_CASE("a missing triangle or a wrong normal would show in the golden frames", "[golden]") {
    const Golden& golden = goldens.front();
    const anim::Scene scene = gallery_scene(golden.scene);
    const std::vector<std::byte> expected = read_pixels(project / "tests/golden" / (golden.scene + ".png"));

    anim::Scene without = scene;
    for (anim::Mesh& mesh : without.meshes) {
        auto& triangles = mesh.primitives.front().triangles;
        triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2));
    }
    CHECK_FALSE(acceptable(difference(expected, render(without, golden.time_s))));

    anim::Scene leaning = scene;
    for (anim::Mesh& mesh : leaning.meshes) {
        for (glm::vec3& normal : mesh.primitives.front().normals) normal = {normal.x, normal.z, -normal.y};
    }
    CHECK_FALSE(acceptable(difference(expected, render(leaning, golden.time_s))));

    CHECK_FALSE(acceptable(difference(expected, render(scene, golden.time_s + 1.0 / 24.0))));
}

}  // namespace gridreel::sequences
