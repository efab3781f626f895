#include "scenes.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace gridreel;
using engine::Film;
using test::SceneBuilder;

namespace {

anim::Light point_light(float candela) {
    anim::Light light;
    light.intensity = candela;
    return light;
}

/// A white floor of 20 m x 20 m seen from straight above, 10 m across.
SceneBuilder floor_from_above() {
    SceneBuilder builder;
    anim::Primitive ground = test::floor(0.0f, 10.0f);
    ground.material = builder.add_material(test::matte(glm::vec3(1.0f)));
    builder.add_mesh(ground);
    builder.add_orthographic({0, 9, 0}, {0, 0, 0}, 5.0);
    return builder;
}

/// What `floor_from_above` reflects straight up of light from (0, 4, 0) with 100 candela: Lambert and a
/// highlight of alpha 1, whose D = 1/pi and V = 0.5 / (cos_l + cos_v) on a straight view.
double expected_radiance(double x, double z) {
    const double squared = x * x + 16.0 + z * z;
    const double cosine = 4.0 / std::sqrt(squared);
    const double half_angle_cosine = std::sqrt(0.5 * (1.0 + cosine));
    const auto fresnel = [](double c) { return 0.04 + 0.96 * std::pow(1.0 - c, 5.0); };
    const double highlight = fresnel(half_angle_cosine) * 0.5 / (cosine + 1.0);
    const double brdf = (1.0 - fresnel(cosine) + highlight) / std::numbers::pi;
    return 100.0 / squared * cosine * brdf;
}

}  // namespace

TEST_CASE("a point light lights a floor as computed by hand", "[engine]") {
    SceneBuilder builder = floor_from_above();
    builder.add_light(point_light(100.0f), {0, 4, 0});
    const Film film = test::render(builder.scene, test::small_picture());
    for (int y = 0; y < 32; y += 5) {
        for (int x = 0; x < 32; x += 5) {
            const double place_x = (x + 0.5) / 32.0 * 10.0 - 5.0;
            const double place_z = (y + 0.5) / 32.0 * 10.0 - 5.0;
            CHECK(film.pixel(x, y)[Film::R] == Approx(expected_radiance(place_x, place_z)).epsilon(1e-4));
        }
    }
}

TEST_CASE("exposure multiplies the picture", "[engine]") {
    SceneBuilder builder = floor_from_above();
    builder.add_light(point_light(100.0f), {0, 4, 0});
    engine::RenderSettings settings = test::small_picture();
    const Film plain = test::render(builder.scene, settings);
    settings.exposure_stops = -2.0f;
    const Film darker = test::render(builder.scene, settings);
    CHECK(darker.pixel(9, 20)[Film::G] == plain.pixel(9, 20)[Film::G] / 4.0f);
    CHECK(darker.pixel(9, 20)[Film::A] == 1.0f);
}

TEST_CASE("a box casts its shadow where lines from the light through its corners meet the floor",
          "[engine]") {
    // A 2 x 2 plate at height 2 under a light at height 4: a shadow of 4 x 4.
    SceneBuilder builder = floor_from_above();
    builder.add_light(point_light(100.0f), {0, 4, 0});
    anim::Primitive plate = test::box({-1.0f, 1.999f, -1.0f}, {1.0f, 2.001f, 1.0f});
    plate.material = 0;
    builder.add_mesh(plate);
    engine::RenderSettings settings = test::small_picture();
    settings.width = settings.height.emplace(40);  // a pixel is 0.25 m: edges fall between pixels
    const Film film = test::render(builder.scene, settings);
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
            const double place_x = std::abs((x + 0.5) * 0.25 - 5.0);
            const double place_z = std::abs((y + 0.5) * 0.25 - 5.0);
            const bool plate_seen = place_x < 1.0 && place_z < 1.0;
            if (plate_seen) continue;
            const bool shadowed = place_x < 2.0 && place_z < 2.0;
            CHECK((film.pixel(x, y)[Film::R] == 0.0f) == shadowed);
        }
    }
}

TEST_CASE("a directional light casts parallel shadows", "[engine]") {
    SceneBuilder builder = floor_from_above();
    anim::Light sun;
    sun.kind = anim::Light::Kind::directional;
    sun.intensity = static_cast<float>(std::numbers::pi);
    // -z turned to (-1, -1, 0) / sqrt(2).
    anim::Node node;
    node.light = 0;
    node.trs.rotation = glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0, 1, 0)) *
                        glm::angleAxis(-std::numbers::pi / 4, glm::dvec3(1, 0, 0));
    builder.scene.lights = {sun};
    builder.add_node(node);
    anim::Primitive plate = test::box({-1.0f, 1.999f, -1.0f}, {1.0f, 2.001f, 1.0f});
    plate.material = 0;
    builder.add_mesh(plate);
    engine::RenderSettings settings = test::small_picture();
    settings.width = settings.height.emplace(40);
    const Film film = test::render(builder.scene, settings);

    // The plate at height 2 throws its shadow two metres towards -x: x in [-3, -1].
    for (int x = 0; x < 40; ++x) {
        const double place_x = (x + 0.5) * 0.25 - 5.0;
        const bool shadowed = place_x > -3.0 && place_x < -1.0;
        CHECK((film.pixel(x, 20)[Film::R] == 0.0f) == shadowed);
    }
    // Diffuse 0.96 * cos(45 degrees) and a little highlight.
    CHECK(film.pixel(2, 2)[Film::R] == Approx(0.96 * std::sqrt(0.5)).epsilon(0.03));
}

TEST_CASE("several lights add up", "[engine]") {
    const auto picture = [](bool left, bool right) {
        SceneBuilder builder = floor_from_above();
        if (left) builder.add_light(point_light(30.0f), {-3, 2, 1});
        if (right) builder.add_light(point_light(50.0f), {4, 3, -1});
        return test::render(builder.scene, test::small_picture());
    };
    const Film left = picture(true, false);
    const Film right = picture(false, true);
    const Film both = picture(true, true);
    for (std::size_t i = 0; i < both.pixels.size(); i += Film::channel_count) {
        CHECK(both.pixels[i] == Approx(left.pixels[i] + right.pixels[i]));
    }
}

TEST_CASE("without lights in the file the choice decides", "[engine]") {
    SceneBuilder builder = floor_from_above();
    engine::RenderSettings settings = test::small_picture();

    settings.lights = engine::LightChoice::file;
    CHECK(test::render(builder.scene, settings).pixel(16, 16)[Film::R] == 0.0f);

    settings.lights = engine::LightChoice::automatic;
    const Film lit = test::render(builder.scene, settings);
    CHECK(lit.pixel(16, 16)[Film::R] > 0.5f);
    CHECK(lit.pixel(16, 16)[Film::R] < 1.0f);
    CHECK_THAT(
        engine::FrameRenderer(builder.scene, {}, settings).notes(),
        Catch::VectorContains(std::string("no light in the scene: lit by the default dome and key light")));

    // With a light in the file, automatic means that light, and standard the default ones.
    builder.add_light(point_light(0.0f), {0, 4, 0});
    CHECK(test::render(builder.scene, settings).pixel(16, 16)[Film::R] == 0.0f);
    settings.lights = engine::LightChoice::standard;
    CHECK(test::render(builder.scene, settings).pixels == lit.pixels);
}

TEST_CASE("emission needs no light", "[engine]") {
    SceneBuilder builder = floor_from_above();
    builder.scene.materials[0].emissive = {0.25f, 0.5f, 2.0f};
    const Film film = test::render(builder.scene, test::small_picture());
    CHECK(film.pixel(3, 4)[Film::R] == 0.25f);
    CHECK(film.pixel(3, 4)[Film::G] == 0.5f);
    CHECK(film.pixel(3, 4)[Film::B] == 2.0f);
}
