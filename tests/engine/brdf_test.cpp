#include "engine/brdf.h"

#include <glm/geometric.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace gridreel;
using engine::Reflectance;

namespace {

constexpr glm::vec3 up{0.0f, 1.0f, 0.0f};
constexpr double pi = std::numbers::pi;

glm::vec3 direction(double polar, double azimuth) {
    return glm::vec3(glm::dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                std::sin(polar) * std::sin(azimuth)));
}

/// Share of uniform light from the whole hemisphere that goes towards the viewer.
double reflected_share(const Reflectance& surface, double view_polar) {
    constexpr int polar_steps = 400;
    constexpr int azimuth_steps = 400;
    const glm::vec3 view = direction(view_polar, 0.0);
    double sum = 0.0;
    for (int i = 0; i < polar_steps; ++i) {
        const double polar = (i + 0.5) / polar_steps * pi / 2;
        for (int j = 0; j < azimuth_steps; ++j) {
            const double azimuth = (j + 0.5) / azimuth_steps * 2 * pi;
            sum += double(engine::brdf(surface, up, view, direction(polar, azimuth)).x) * std::cos(polar) *
                   std::sin(polar);
        }
    }
    return sum * (pi / 2 / polar_steps) * (2 * pi / azimuth_steps);
}

}  // namespace

TEST_CASE("white metal in a white furnace never glows", "[engine]") {
    const float roughness = GENERATE(0.3f, 0.5f, 1.0f);
    const Reflectance surface = engine::reflectance(glm::vec3(1.0f), 1.0f, roughness);
    for (const double polar : {0.0, 0.6, 1.2, 1.45}) {
        const double share = reflected_share(surface, polar);
        CHECK(share < 1.001);
        CHECK(share > 0.3);  // rough GGX loses light that bounces twice, but not most of it
    }
}

TEST_CASE("white plastic in a white furnace never glows", "[engine]") {
    const float roughness = GENERATE(0.2f, 0.3f, 0.5f, 1.0f);
    const Reflectance surface = engine::reflectance(glm::vec3(1.0f), 0.0f, roughness);
    for (const double polar : {0.0, 0.6, 1.0, 1.3, 1.45}) CHECK(reflected_share(surface, polar) < 1.005);
    CHECK(reflected_share(surface, 0.3) > 0.85);
}

TEST_CASE("a smooth metal mirrors nearly all, a rough dielectric is nearly Lambert", "[engine]") {
    CHECK(reflected_share(engine::reflectance(glm::vec3(1.0f), 1.0f, 0.3f), 0.4) ==
          Approx(1.0).epsilon(0.02));
    CHECK(reflected_share(engine::reflectance(glm::vec3(0.5f), 0.0f, 1.0f), 0.4) ==
          Approx(0.5).epsilon(0.08));
}

TEST_CASE("light and viewer may change places", "[engine]") {
    const float roughness = GENERATE(0.0f, 0.2f, 0.7f, 1.0f);
    const Reflectance surface = engine::reflectance({0.9f, 0.5f, 0.1f}, 0.3f, roughness);
    for (int i = 0; i < 20; ++i) {
        const glm::vec3 a = direction(0.07 * i, 0.3 * i);
        const glm::vec3 b = direction(1.5 - 0.05 * i, 1.0 + 0.7 * i);
        const glm::vec3 there = engine::brdf(surface, up, a, b);
        const glm::vec3 back = engine::brdf(surface, up, b, a);
        for (int c = 0; c < 3; ++c) CHECK(there[c] == Approx(back[c]).epsilon(1e-4));
    }
}

TEST_CASE("a rough surface seen and lit from straight above follows the formula by hand", "[engine]") {
    // alpha = 1: D = 1/pi, V = 1/4, F = 0.04: highlight 0.01/pi; diffuse 0.96 * 0.5/pi.
    const Reflectance surface = engine::reflectance(glm::vec3(0.5f), 0.0f, 1.0f);
    CHECK(engine::brdf(surface, up, up, up).x == Approx((0.01 + 0.48) / pi));
    // Roughness 0.5: alpha 0.25, D = 1/(pi alpha^2) = 16/pi, V = 1/4.
    const Reflectance smoother = engine::reflectance(glm::vec3(0.5f), 0.0f, 0.5f);
    CHECK(engine::brdf(smoother, up, up, up).x == Approx((0.04 * 16 / 4 + 0.48) / pi));
}

TEST_CASE("metal has no diffuse part and a coloured highlight", "[engine]") {
    const Reflectance gold = engine::reflectance({1.0f, 0.8f, 0.3f}, 1.0f, 0.4f);
    CHECK(gold.diffuse == glm::vec3(0.0f));
    CHECK(gold.specular == glm::vec3(1.0f, 0.8f, 0.3f));
}

TEST_CASE("nothing is reflected below the surface", "[engine]") {
    const Reflectance surface = engine::reflectance(glm::vec3(1.0f), 0.0f, 0.5f);
    CHECK(engine::brdf(surface, up, up, -up) == glm::vec3(0.0f));
    CHECK(engine::brdf(surface, up, -up, up) == glm::vec3(0.0f));
    CHECK(engine::brdf(surface, up, up, glm::vec3(1.0f, 0.0f, 0.0f)) == glm::vec3(0.0f));
}

TEST_CASE("the ambient highlight follows the integral it stands for", "[engine]") {
    const float roughness = GENERATE(0.3f, 0.6f, 1.0f);
    const double polar = GENERATE(0.1, 0.8, 1.2);
    const Reflectance metal = engine::reflectance(glm::vec3(0.8f), 1.0f, roughness);
    const double expected = reflected_share(metal, polar);
    CHECK(double(engine::ambient_specular(metal, static_cast<float>(std::cos(polar))).x) ==
          Approx(expected).margin(0.13));
}
