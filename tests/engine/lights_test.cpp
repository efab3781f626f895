#include "engine/lights.h"

#include "engine/choose_lights.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using namespace gridreel;
using engine::Arrival;
using engine::PosedLight;

namespace {

anim::Light light_of(anim::Light::Kind kind) {
    anim::Light light;
    light.kind = kind;
    light.color = {1.0f, 0.5f, 0.25f};
    light.intensity = 8.0f;
    return light;
}

}  // namespace

TEST_CASE("a point light weakens with the square of the distance", "[engine]") {
    const glm::dmat4 world = glm::translate(glm::dmat4(1.0), {0.0, 3.0, 0.0});
    const PosedLight light = *engine::posed_light(light_of(anim::Light::Kind::point), world);
    const Arrival arrival = engine::arrival_at(light, {0.0f, 1.0f, 0.0f});
    CHECK(arrival.distance == Approx(2.0f));
    CHECK(arrival.to_light == glm::vec3(0.0f, 1.0f, 0.0f));
    CHECK(arrival.irradiance.x == Approx(8.0f / 4.0f));
    CHECK(arrival.irradiance.y == Approx(0.5f * 8.0f / 4.0f));
    CHECK(arrival.irradiance.z == Approx(0.25f * 8.0f / 4.0f));
}

TEST_CASE("a light's range ends it smoothly", "[engine]") {
    anim::Light ranged = light_of(anim::Light::Kind::point);
    ranged.range_m = 4.0f;
    const PosedLight light = *engine::posed_light(ranged, glm::dmat4(1.0));
    // (1 - (2/4)^4) / 2^2 = (15/16) / 4
    CHECK(engine::arrival_at(light, {2.0f, 0.0f, 0.0f}).irradiance.x == Approx(8.0f * 15.0f / 64.0f));
    CHECK(engine::arrival_at(light, {4.0f, 0.0f, 0.0f}).irradiance.x == 0.0f);
    CHECK(engine::arrival_at(light, {9.0f, 0.0f, 0.0f}).irradiance.x == 0.0f);
}

TEST_CASE("a directional light is the same everywhere and shines along its node's -z", "[engine]") {
    // Turned a quarter about x, -z becomes -y... upside: (0, 0, -1) -> (0, 1, 0).
    const glm::dmat4 world =
        glm::scale(glm::rotate(glm::dmat4(1.0), std::numbers::pi / 2, {1.0, 0.0, 0.0}), {3.0, 3.0, 3.0});
    const PosedLight light = *engine::posed_light(light_of(anim::Light::Kind::directional), world);
    const Arrival arrival = engine::arrival_at(light, {100.0f, -50.0f, 7.0f});
    CHECK(glm::distance(arrival.to_light, glm::vec3(0.0f, -1.0f, 0.0f)) < 1e-6f);
    CHECK(arrival.distance == std::numeric_limits<float>::infinity());
    CHECK(arrival.irradiance.x == Approx(8.0f));
}

TEST_CASE("a spot light fades from its inner to its outer cone", "[engine]") {
    anim::Light spot = light_of(anim::Light::Kind::spot);
    spot.inner_cone_rad = 0.3f;
    spot.outer_cone_rad = 0.6f;
    const PosedLight light = *engine::posed_light(spot, glm::dmat4(1.0));
    const auto at_angle = [&](float angle) {
        return engine::arrival_at(light, {std::sin(angle), 0.0f, -std::cos(angle)}).irradiance.x / 8.0f;
    };
    const auto ramp = [](float angle) {
        return (std::cos(angle) - std::cos(0.6f)) / (std::cos(0.3f) - std::cos(0.6f));
    };
    CHECK(at_angle(0.0f) == Approx(1.0f));
    CHECK(at_angle(0.29f) == Approx(1.0f));
    CHECK(at_angle(0.45f) == Approx(ramp(0.45f) * ramp(0.45f)).epsilon(1e-4));
    CHECK(at_angle(0.55f) == Approx(ramp(0.55f) * ramp(0.55f)).epsilon(1e-4));
    CHECK(at_angle(0.61f) == 0.0f);
    CHECK(at_angle(3.0f) == 0.0f);
}

TEST_CASE("a spot light whose cones coincide is on inside and off outside", "[engine]") {
    anim::Light spot = light_of(anim::Light::Kind::spot);
    spot.inner_cone_rad = spot.outer_cone_rad = 0.5f;
    const PosedLight light = *engine::posed_light(spot, glm::dmat4(1.0));
    CHECK(engine::arrival_at(light, {0.0f, 0.0f, -1.0f}).irradiance.x == Approx(8.0f));
    CHECK(engine::arrival_at(light, {std::sin(0.51f), 0.0f, -std::cos(0.51f)}).irradiance.x == 0.0f);
}

TEST_CASE("a light brighter than a float holds stays a number, also where it does not shine", "[engine]") {
    anim::Light spot = light_of(anim::Light::Kind::spot);
    spot.color = glm::vec3(3e38f, 0.0f, 1.0f);
    spot.intensity = 10.0f;
    const PosedLight light = *engine::posed_light(spot, glm::dmat4(1.0));
    CHECK(engine::arrival_at(light, {0.0f, 0.0f, 1.0f}).irradiance == glm::vec3(0.0f));
}

TEST_CASE("a light gives nothing at its own place, and a flattened one does not shine", "[engine]") {
    const PosedLight light = *engine::posed_light(light_of(anim::Light::Kind::point), glm::dmat4(1.0));
    CHECK(engine::arrival_at(light, {0.0f, 0.0f, 0.0f}).irradiance == glm::vec3(0.0f));
    const glm::dmat4 flat = glm::scale(glm::dmat4(1.0), {1.0, 1.0, 0.0});
    CHECK(!engine::posed_light(light_of(anim::Light::Kind::spot), flat));
    CHECK(engine::posed_light(light_of(anim::Light::Kind::point), flat));
}

TEST_CASE("the dome's diffuse light is the cosine-weighted mean of its radiance", "[engine]") {
    const engine::Dome dome{.sky = {1.0f, 0.8f, 0.6f}, .ground = {0.1f, 0.2f, 0.3f}};
    const glm::vec3 normal = glm::normalize(glm::vec3{0.3f, 0.5f, -0.8f});
    const glm::vec3 side = glm::normalize(glm::cross(normal, glm::vec3{1.0f, 0.0f, 0.0f}));
    const glm::vec3 other = glm::cross(normal, side);

    // Equal shares of projected solid angle: sin^2 and azimuth in even steps.
    glm::dvec3 sum{0.0};
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i) {
        const float sine = std::sqrt((static_cast<float>(i) + 0.5f) / steps);
        for (int j = 0; j < steps; ++j) {
            const float azimuth = 2.0f * std::numbers::pi_v<float> * (static_cast<float>(j) + 0.5f) / steps;
            const glm::vec3 direction = std::sqrt(1.0f - sine * sine) * normal +
                                        sine * (std::cos(azimuth) * side + std::sin(azimuth) * other);
            sum += glm::dvec3(dome.radiance(direction));
        }
    }
    const glm::vec3 mean(sum / double(steps * steps));
    const glm::vec3 diffuse = dome.diffuse(normal);
    for (int i = 0; i < 3; ++i) CHECK(diffuse[i] == Approx(mean[i]).epsilon(1e-3));
}

TEST_CASE("the default light leaves white just below clipping, whichever way it faces", "[engine]") {
    const engine::Lighting lighting = engine::default_lighting({-1, -1, -1}, {1, 1, 1});
    REQUIRE(lighting.lights.size() == 1);
    const Arrival key = engine::arrival_at(lighting.lights[0], {0.0f, 0.0f, 0.0f});
    float brightest = 0.0f;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 40; ++j) {
            const float y = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / 20.0f;
            const float azimuth = 2.0f * std::numbers::pi_v<float> * static_cast<float>(j) / 40.0f;
            const float r = std::sqrt(1.0f - y * y);
            const glm::vec3 normal{r * std::cos(azimuth), y, r * std::sin(azimuth)};
            const glm::vec3 reflected = lighting.dome.diffuse(normal) +
                                        key.irradiance * std::max(0.0f, glm::dot(normal, key.to_light)) *
                                            std::numbers::inv_pi_v<float>;
            brightest = std::max({brightest, reflected.x, reflected.y, reflected.z});
        }
    }
    CHECK(brightest > 0.9f);
    CHECK(brightest < 1.0f);
}

TEST_CASE("the default key light comes from the upper right front at any scale", "[engine]") {
    const float scale = GENERATE(1e-3f, 1.0f, 1e5f);
    const engine::Lighting lighting = engine::default_lighting(glm::vec3(0.0f), glm::vec3(scale));
    const Arrival near = engine::arrival_at(lighting.lights[0], glm::vec3(0.0f));
    const Arrival far = engine::arrival_at(lighting.lights[0], glm::vec3(scale));
    CHECK((near.to_light.x > 0.0f && near.to_light.y > 0.0f && near.to_light.z > 0.0f));
    CHECK(near.irradiance == far.irradiance);
    CHECK(glm::dot(near.to_light, far.to_light) > 0.99f);
}
