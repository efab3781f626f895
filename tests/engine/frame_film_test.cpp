#include "anim/error.h"
#include "encoded_images.h"
#include "scenes.h"

#include <glm/geometric.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace gridreel;
using engine::Film;
using test::SceneBuilder;

namespace {

/// A glowing red square of 2 m at z = 0, seen from z = 5 by a camera that shows 4 m of its plane.
SceneBuilder red_square() {
    SceneBuilder builder;
    anim::Material red = test::matte(glm::vec3(0.0f));
    red.emissive = {1, 0, 0};
    anim::Primitive square = test::quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    square.material = builder.add_material(red);
    builder.add_mesh(square);
    builder.add_camera({0, 0, 5}, {0, 0, 0}, 2.0 * std::atan(2.0 / 5.0));
    return builder;
}

}  // namespace

TEST_CASE("a square covers the pixels that perspective gives it", "[engine]") {
    const Film film = test::render(red_square().scene, test::small_picture());
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool inside = x >= 8 && x < 24 && y >= 8 && y < 24;
            CHECK(film.pixel(x, y)[Film::A] == (inside ? 1.0f : 0.0f));
            CHECK(film.pixel(x, y)[Film::R] == (inside ? 1.0f : 0.0f));
        }
    }
}

TEST_CASE("Z is the depth along the view axis and N the normal; both empty where nothing was hit",
          "[engine]") {
    const Film film = test::render(red_square().scene, test::small_picture());
    const float* hit = film.pixel(9, 22);
    CHECK(hit[Film::Z] == Approx(5.0f));
    CHECK(hit[Film::NX] == 0.0f);
    CHECK(hit[Film::NY] == 0.0f);
    CHECK(hit[Film::NZ] == 1.0f);
    const float* miss = film.pixel(1, 1);
    CHECK(miss[Film::Z] == std::numeric_limits<float>::infinity());
    CHECK(miss[Film::NZ] == 0.0f);
}

TEST_CASE("the background is premultiplied, and mixes with what covers part of a pixel", "[engine]") {
    SceneBuilder builder = red_square();
    engine::RenderSettings settings = test::small_picture();
    settings.background = {0.2f, 0.4f, 0.8f, 0.5f};
    settings.width = settings.height.emplace(31);  // the edge runs through pixels: 31 / 4 = 7.75
    settings.samples = 16;
    const Film film = test::render(builder.scene, settings);
    CHECK(film.pixel(0, 0)[Film::R] == Approx(0.1f));
    CHECK(film.pixel(0, 0)[Film::G] == Approx(0.2f));
    CHECK(film.pixel(0, 0)[Film::B] == Approx(0.4f));
    CHECK(film.pixel(0, 0)[Film::A] == 0.5f);
    // Pixel 7 is covered from 7.75 on: 4 of 16 samples, one in each sixteenth of the width.
    CHECK(film.pixel(7, 15)[Film::A] == Approx(0.25f + 0.75f * 0.5f));
    CHECK(film.pixel(7, 15)[Film::R] == Approx(0.25f + 0.75f * 0.1f));
    CHECK(film.pixel(7, 15)[Film::B] == Approx(0.75f * 0.4f));
}

TEST_CASE("Z and N are of the nearest sample", "[engine]") {
    SceneBuilder builder = red_square();
    anim::Primitive wall = test::quad({-9, -9, -3}, {9, -9, -3}, {9, 9, -3}, {-9, 9, -3});
    wall.material = 0;
    builder.add_mesh(wall);
    engine::RenderSettings settings = test::small_picture();
    settings.width = settings.height.emplace(31);
    settings.samples = 16;
    const Film film = test::render(builder.scene, settings);
    CHECK(film.pixel(7, 15)[Film::Z] == Approx(5.0f));
    CHECK(film.pixel(6, 15)[Film::Z] == Approx(8.0f));
}

TEST_CASE("nothing nearer than near or farther than far is seen", "[engine]") {
    SceneBuilder builder = red_square();
    engine::RenderSettings settings = test::small_picture();
    builder.scene.cameras[0].near_m = 4.9;
    builder.scene.cameras[0].far_m = 5.1;
    CHECK(test::render(builder.scene, settings).pixel(8, 8)[Film::A] == 1.0f);
    builder.scene.cameras[0].near_m = 5.1;
    builder.scene.cameras[0].far_m = 9.0;
    CHECK(test::render(builder.scene, settings).pixel(8, 8)[Film::A] == 0.0f);
    builder.scene.cameras[0].near_m = 1.0;
    builder.scene.cameras[0].far_m = 4.9;
    CHECK(test::render(builder.scene, settings).pixel(8, 8)[Film::A] == 0.0f);
}

TEST_CASE("a texture is upright and unmirrored on a quad", "[engine]") {
    SceneBuilder builder = red_square();
    // Top row red, green; bottom row blue, white.
    builder.scene.images = {test::png(2, 2, 3, {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255})};
    builder.scene.textures = {{.image = 0, .mag_filter = anim::Filter::nearest}};
    builder.scene.materials[0].emissive = glm::vec3(1.0f);
    builder.scene.materials[0].emissive_texture = anim::TextureRef{.texture = 0};
    builder.scene.meshes[0].primitives[0].texcoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    const Film film = test::render(builder.scene, test::small_picture());
    const auto color = [&](int x, int y) {
        const float* pixel = film.pixel(x, y);
        return glm::vec3{pixel[Film::R], pixel[Film::G], pixel[Film::B]};
    };
    CHECK(color(10, 10) == glm::vec3(1, 0, 0));
    CHECK(color(21, 10) == glm::vec3(0, 1, 0));
    CHECK(color(10, 21) == glm::vec3(0, 0, 1));
    CHECK(color(21, 21) == glm::vec3(1, 1, 1));
}

TEST_CASE("a fine texture far away is averaged, not sampled", "[engine]") {
    SceneBuilder builder = red_square();
    std::vector<std::uint8_t> checks;
    for (int i = 0; i < 256 * 256; ++i) checks.push_back((i + i / 256) % 2 == 0 ? 0 : 255);
    builder.scene.images = {test::png(256, 256, 1, checks)};
    builder.scene.textures = {{.image = 0}};
    builder.scene.materials[0].emissive = glm::vec3(1.0f);
    builder.scene.materials[0].emissive_texture = anim::TextureRef{.texture = 0};
    const Film film = test::render(builder.scene, test::small_picture());
    for (int y = 8; y < 24; ++y) {
        for (int x = 8; x < 24; ++x) CHECK(film.pixel(x, y)[Film::R] == Approx(0.5f).margin(1e-3));
    }
}

TEST_CASE("interpolated normals are unit and between the corners'", "[engine]") {
    SceneBuilder builder = red_square();
    const float tilt = std::sqrt(0.5f);
    builder.scene.meshes[0].primitives[0].normals = {
        {-tilt, 0, tilt}, {tilt, 0, tilt}, {tilt, 0, tilt}, {-tilt, 0, tilt}};
    const Film film = test::render(builder.scene, test::small_picture());
    for (int x = 8; x < 24; ++x) {
        const float* pixel = film.pixel(x, 12);
        const float along = (static_cast<float>(x) + 0.5f - 16.0f) / 8.0f;  // -1 … 1 over the square
        const glm::vec3 expected = glm::normalize(glm::vec3{along * tilt, 0.0f, tilt});
        CHECK(pixel[Film::NX] == Approx(expected.x).margin(1e-5));
        CHECK(pixel[Film::NY] == Approx(0.0f).margin(1e-5));
        CHECK(pixel[Film::NZ] == Approx(expected.z).margin(1e-5));
    }
}

TEST_CASE("the height follows the camera when it is left open", "[engine]") {
    SceneBuilder builder = red_square();
    engine::RenderSettings settings = test::small_picture();
    settings.width = 120;
    settings.height.reset();
    builder.scene.cameras[0].aspect = 1.5;
    const engine::FrameRenderer renderer(builder.scene, {}, settings);
    CHECK(renderer.width() == 120);
    CHECK(renderer.height() == 80);
}

TEST_CASE("a scene without camera is framed whole, and a note says so", "[engine]") {
    SceneBuilder builder;
    builder.add_mesh(test::sphere({50, 60, 70}, 3.0f, 8, true));
    engine::RenderSettings settings = test::small_picture();
    engine::FrameRenderer renderer(builder.scene, {}, settings);
    CHECK_THAT(
        renderer.notes(),
        Catch::VectorContains(std::string("no camera in the scene: framing the whole clip from the front")));
    Film film;
    renderer.render(0.0, film);
    int covered = 0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool hit = film.pixel(x, y)[Film::A] > 0.0f;
            covered += hit;
            if (x == 0 || y == 0 || x == 31 || y == 31) CHECK(!hit);
        }
    }
    CHECK(covered > 200);
}

TEST_CASE("a scene without triangles gives the background and a note", "[engine]") {
    const SceneBuilder builder;
    engine::RenderSettings settings = test::small_picture();
    settings.background = {1, 0, 0, 1};
    engine::FrameRenderer renderer(builder.scene, {}, settings);
    CHECK_THAT(
        renderer.notes(),
        Catch::VectorContains(std::string("no triangles in the scene: pictures show the background only")));
    Film film;
    renderer.render(0.0, film);
    CHECK(film.pixel(5, 5)[Film::R] == 1.0f);
}

TEST_CASE("settings out of range and unknown cameras are refused", "[engine]") {
    const SceneBuilder builder = red_square();
    engine::RenderSettings settings = test::small_picture();
    settings.samples = 0;
    CHECK_THROWS_AS(engine::FrameRenderer(builder.scene, {}, settings), std::invalid_argument);
    settings = test::small_picture();
    settings.width = 70000;
    CHECK_THROWS_AS(engine::FrameRenderer(builder.scene, {}, settings), std::invalid_argument);
    settings = test::small_picture();
    settings.camera = "nowhere";
    CHECK_THROWS_AS(engine::FrameRenderer(builder.scene, {}, settings), Error);
}
