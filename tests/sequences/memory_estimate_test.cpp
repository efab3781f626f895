#include "sequences/memory_estimate.h"

#include <catch2/catch.hpp>
#include <glm/gtc/type_precision.hpp>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <span>
#include <vector>

using namespace gridreel;
using namespace gridreel::sequences;

namespace {

/// Triangles without a file behind them, in the unit cube.
anim::FrameGeometry triangles(std::size_t count) {
    anim::FrameGeometry geometry;
    geometry.positions.resize(3 * count);
    geometry.normals.resize(3 * count);
    geometry.triangles.resize(count);
    geometry.triangle_part.resize(count);
    return geometry;
}

anim::Box unit_cube() {
    anim::Box box;
    box.extend(glm::vec3(0.0f));
    box.extend(glm::vec3(1.0f));
    return box;
}

MemoryEstimate estimate(std::size_t triangle_count, const engine::RenderSettings& settings = {},
                        int threads = 1) {
    return estimate_memory({}, triangles(triangle_count), unit_cube(), settings, threads);
}

anim::Image grey_png(int width, int height) {
    OIIO::Filesystem::IOVecOutput bytes;
    const auto out = OIIO::ImageOutput::create("png");
    REQUIRE(out);
    REQUIRE(out->set_ioproxy(&bytes));
    REQUIRE(out->open("grey.png", OIIO::ImageSpec(width, height, 1, OIIO::TypeDesc::UINT8)));
    const std::vector<std::uint8_t> values(static_cast<std::size_t>(width * height), 128);
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, values.data()));
    REQUIRE(out->close());
    const auto encoded = std::as_bytes(std::span(bytes.buffer()));
    return {.name = "grey", .mime_type = "", .encoded = {encoded.begin(), encoded.end()}};
}

/// One material whose base colour is an image of that size.
anim::Scene textured(const anim::Image& image) {
    anim::Scene scene;
    scene.images = {image};
    scene.textures.push_back({.image = 0});
    scene.materials.resize(1);
    scene.materials[0].base_color_texture = anim::TextureRef{};
    return scene;
}

std::size_t texture_bytes(const anim::Scene& scene) {
    return estimate_memory(scene, {}, {}, {}, 1).textures;
}

}  // namespace

TEST_CASE("more triangles take more memory, all else the same", "[memory]") {
    const MemoryEstimate few = estimate(1'000), many = estimate(100'000);
    CHECK(few.geometry == 1'000 * (3 * 24 + 12 + 4));
    CHECK(many.geometry == 100 * few.geometry);
    CHECK(many.grid > 50 * few.grid);
    CHECK(many.rays == few.rays);
    CHECK(many.films == few.films);
    CHECK(many.total() > few.total());
}

TEST_CASE("a grid takes its cells, references, room to find them, and histograms", "[memory]") {
    // 10 x 10 x 10 cells for 1000 triangles whose edges are sqrt(0.002) = 0.0447 of the cube's: 0.447 cells.
    const double references = 1.447213595 * 1.447213595 * 1.447213595;
    CHECK(assumed_references_per_triangle(1'000, 1.0) == Approx(references));
    const MemoryEstimate one = estimate(1'000, {}, 1);
    CHECK(one.references_per_triangle == Approx(references));
    // Room for the cells of a tenth more, and for all triangles.
    CHECK(
        double(one.grid) ==
        Approx(2 * 1'000 * 4 + references * 1'000 * 4 + 1.1 * references * 1'000 * 4 + 1'000 * 4).margin(16));
}

TEST_CASE("triangles of few references take room for some more", "[memory]") {
    engine::RenderSettings settings;
    settings.tracer.resolution.lambda = 0.125f;  // 5 x 5 x 5 cells, edges of 0.224 cells
    const double references = 1.223606798 * 1.223606798 * 1.223606798;
    const MemoryEstimate coarse = estimate(1'000, settings);
    CHECK(coarse.references_per_triangle == Approx(references));
    CHECK(double(coarse.grid) == Approx(2 * 125 * 4 + references * 1'000 * 4 + 3.5 * 1'000 * 4).margin(16));
}

TEST_CASE("each thread takes a histogram, where there are triangles enough", "[memory]") {
    // 64,000 triangles, 40 x 40 x 40 cells: histograms for 7 threads at most; 216,000 for 16 and no more.
    const auto grid = [](std::size_t count, int threads) { return estimate(count, {}, threads).grid; };
    CHECK(grid(1'000, 8) == grid(1'000, 1));
    CHECK(grid(64'000, 3) == grid(64'000, 1) + 2 * 64'000 * 4);
    CHECK(grid(64'000, 100) == grid(64'000, 1) + 6 * 64'000 * 4);
    CHECK(grid(216'000, 100) == grid(216'000, 1) + 15 * 216'000 * 4);
}

TEST_CASE("finer grids list triangles more often, up to the builder's limit", "[memory]") {
    CHECK(assumed_references_per_triangle(1'000, 5.0) > assumed_references_per_triangle(1'000, 1.0));
    CHECK(assumed_references_per_triangle(1'000'000, 1.0) < assumed_references_per_triangle(1'000, 1.0));
    CHECK(assumed_references_per_triangle(2, 1e6) == 64.0);
    CHECK(assumed_references_per_triangle(0, 1.0) == 0.0);
}

TEST_CASE("vertices astronomically far away are no harm", "[memory]") {
    anim::Box box;
    box.extend(glm::vec3(-3e38f));
    box.extend(glm::vec3(3e38f));
    const auto grid = [](const anim::Box& bounds) {
        return estimate_memory({}, triangles(1'000), bounds, {}, 1).grid;
    };
    CHECK(grid(box) == grid(unit_cube()));
    CHECK(grid({}) < grid(unit_cube()));
}

TEST_CASE("textures take eight bytes a texel and a third more for the smaller sizes", "[memory]") {
    CHECK(texture_bytes({}) == 0);
    CHECK(texture_bytes(textured(grey_png(96, 64))) == 96 * 64 * 8 * 4 / 3);
    CHECK(texture_bytes(textured({})) == 0);

    anim::Scene twice = textured(grey_png(96, 64));
    twice.materials[0].emissive_texture = anim::TextureRef{};
    CHECK(texture_bytes(twice) == 96 * 64 * 8 * 4 / 3);  // a colour as well
    twice.materials[0].metallic_roughness_texture = anim::TextureRef{};
    CHECK(texture_bytes(twice) == 2 * 96 * 64 * 8 * 4 / 3);
    CHECK(estimate_memory(twice, {}, {}, {}, 1).scene == twice.images[0].encoded.size());
}

TEST_CASE("larger pictures take more for films, and for rays until a band is full", "[memory]") {
    const auto sized = [](std::int32_t width, std::int32_t height) {
        engine::RenderSettings settings;
        settings.width = width;
        settings.height = height;
        settings.samples = 1;
        return estimate(0, settings);
    };
    CHECK(sized(200, 100).films == 200 * 100 * (3 * 8 * 4 + 2 * 8));
    CHECK(sized(400, 100).films == 2 * sized(200, 100).films);
    CHECK(sized(400, 100).rays == 2 * sized(200, 100).rays);
    // Beyond the two million rays of a band only the order of the pixels grows.
    CHECK(sized(4'000, 2'000).rays - sized(2'000, 2'000).rays == 2'000 * 2'000 * 4);
}
