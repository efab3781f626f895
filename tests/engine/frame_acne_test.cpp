#include "scenes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace gridreel;
using engine::Film;
using test::SceneBuilder;

namespace {

struct Speckles {
    int lit = 0;       ///< pixels that are asked about
    int shadowed = 0;  ///< of these, without light
};

anim::Light light_for(float scale) {
    anim::Light light;
    light.intensity = 100.0f * scale * scale;
    return light;
}

/// Looks at one convex thing and counts the pixels that ought to be lit and are not.
/// @param faces_light  by film pixel, of those that show the thing
template <class FacesLight>
Speckles count(const anim::Scene& scene, FacesLight faces_light) {
    engine::RenderSettings settings = test::small_picture();
    settings.width = settings.height.emplace(96);
    const Film film = test::render(scene, settings);
    Speckles found;
    for (int y = 0; y < film.height; ++y) {
        for (int x = 0; x < film.width; ++x) {
            const float* pixel = film.pixel(x, y);
            if (pixel[Film::A] == 0.0f ||
                !faces_light(glm::vec3{pixel[Film::NX], pixel[Film::NY], pixel[Film::NZ]}, pixel[Film::Z]))
                continue;
            ++found.lit;
            found.shadowed += pixel[Film::R] == 0.0f;
        }
    }
    return found;
}

}  // namespace

TEST_CASE("a floor does not shadow itself at any scale or distance from the origin", "[engine]") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f, 1e6f);
    const float shift = GENERATE(0.0f, 100.0f);  // in units of the scale
    const float height = GENERATE(0.02f, 1.0f, 30.0f);

    SceneBuilder builder;
    anim::Primitive ground = test::floor(0.0f, scale);
    ground.material = builder.add_material(test::matte(glm::vec3(1.0f)));
    const glm::vec3 away{shift * scale, shift * scale, -shift * scale};
    for (glm::vec3& position : ground.positions) position += away;
    builder.add_mesh(ground);
    builder.add_light(light_for(scale), glm::dvec3(away + scale * glm::vec3{0.3f, height, 0.2f}));
    builder.add_camera(glm::dvec3(away + scale * glm::vec3{1.0f, 1.2f, 2.0f}), glm::dvec3(away), 0.9);

    const Speckles found = count(builder.scene, [](const glm::vec3&, float) { return true; });
    CHECK(found.lit > 1000);
    CHECK(found.shadowed == 0);
}

TEST_CASE("a sphere does not shadow its lit side", "[engine]") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e3f, 1e6f);
    const int rings = GENERATE(8, 60);
    const bool smooth = GENERATE(false, true);

    SceneBuilder builder;
    anim::Primitive ball = test::sphere(glm::vec3(0.0f), scale, rings, smooth);
    ball.material = builder.add_material(test::matte(glm::vec3(1.0f)));
    builder.add_mesh(ball);
    const glm::vec3 light = scale * glm::vec3{3.0f, 4.0f, 5.0f};
    builder.add_light(light_for(scale), glm::dvec3(light));
    builder.add_camera(glm::dvec3(0.0, 0.0, 4.0 * double(scale)), glm::dvec3(0.0), 0.6);

    // On a smooth sphere the normal is the place; on a flat one facets near the terminator may go either way.
    const float margin = smooth ? 0.01f : 0.3f;
    const Speckles found = count(builder.scene, [&](const glm::vec3& normal, float) {
        return glm::dot(normal, glm::normalize(light - scale * normal)) > margin;
    });
    CHECK(found.lit > 1000);
    CHECK(found.shadowed == 0);
}

TEST_CASE("triangles much smaller than their distance do not shadow themselves", "[engine]") {
    // A gently rolling sheet of 3 mm triangles, seen and lit from 10 m.
    constexpr int side = 120;
    SceneBuilder builder;
    anim::Primitive sheet;
    for (int i = 0; i <= side; ++i) {
        for (int j = 0; j <= side; ++j) {
            const float x = 0.003f * static_cast<float>(j - side / 2);
            const float z = 0.003f * static_cast<float>(i - side / 2);
            sheet.positions.emplace_back(x, 0.01f * std::sin(12.0f * x) * std::cos(9.0f * z), z);
        }
    }
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const auto at = static_cast<std::uint32_t>(i * (side + 1) + j);
            const auto below = at + static_cast<std::uint32_t>(side + 1);
            sheet.triangles.emplace_back(at, below, at + 1);
            sheet.triangles.emplace_back(at + 1, below, below + 1);
        }
    }
    sheet.material = builder.add_material(test::matte(glm::vec3(1.0f)));
    builder.add_mesh(sheet);
    builder.add_light(light_for(10.0f), {6, 5, 6});
    builder.add_camera({0, 8, 6}, {0, 0, 0}, 0.03);

    const Speckles found = count(builder.scene, [](const glm::vec3&, float) { return true; });
    CHECK(found.lit > 5000);
    CHECK(found.shadowed == 0);
}

TEST_CASE("light from behind never leaks through a surface whose normals lean towards it", "[engine]") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e6f);
    const auto kind = GENERATE(anim::Light::Kind::point, anim::Light::Kind::directional);

    // A wide wall facing +z, lit from behind and above. Like a gutter's, the normals of its lower edge lean
    // upwards, towards the light. Its long triangles make the depth of hits as uncertain as it gets.
    SceneBuilder builder;
    anim::Primitive wall = test::quad({-40 * scale, -scale, 0}, {40 * scale, -scale, 0},
                                      {40 * scale, scale, 0}, {-40 * scale, scale, 0});
    wall.normals = {{0, 0.6f, 0.8f}, {0, 0.6f, 0.8f}, {0, -0.6f, 0.8f}, {0, -0.6f, 0.8f}};
    wall.material = builder.add_material(test::matte(glm::vec3(1.0f)));
    builder.add_mesh(wall);
    anim::Light light = light_for(scale);
    light.kind = kind;
    // Shines along (0, -1, 0.3): from above and a little behind.
    anim::Node node;
    node.light = 0;
    node.matrix = glm::inverse(
        glm::lookAt(glm::dvec3(0.0, 5.0, -1.5) * double(scale), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0)));
    builder.scene.lights = {light};
    builder.add_node(node);
    builder.add_camera(glm::dvec3(0.0, 0.0, 4.0 * double(scale)), glm::dvec3(0.0), 0.4);

    const Speckles found = count(builder.scene, [](const glm::vec3&, float) { return true; });
    CHECK(found.lit > 5000);
    CHECK(found.shadowed == found.lit);
}
