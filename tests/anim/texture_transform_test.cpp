#include "anim/texture_transform.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

using gridreel::anim::TextureTransform;

namespace {

void check_same(const glm::vec2& value, const glm::vec2& expected) {
    CHECK(value.x == Approx(expected.x).margin(1e-6));
    CHECK(value.y == Approx(expected.y).margin(1e-6));
}

constexpr float quarter = std::numbers::pi_v<float> / 2;

}  // namespace

TEST_CASE("a transform left empty changes no bit of a coordinate", "[texture_transform]") {
    for (const glm::vec2 uv : {glm::vec2(0.1f, 0.7f), glm::vec2(-3e-30f, 1e30f)})
        CHECK(TextureTransform{}.apply(uv) == uv);
}

TEST_CASE("the extension's own example shows the lower left quarter of the image", "[texture_transform]") {
    // KHR_texture_transform: "utilizes only the lower left quadrant of the source image".
    const TextureTransform quadrant{.offset = {0, 1}, .rotation_rad = quarter, .scale = glm::vec2(0.5f)};
    check_same(quadrant.apply({0, 0}), {0, 1});
    check_same(quadrant.apply({1, 0}), {0, 0.5f});
    check_same(quadrant.apply({0, 1}), {0.5f, 1});
    check_same(quadrant.apply({1, 1}), {0.5f, 0.5f});
}

TEST_CASE("a positive rotation turns counter-clockwise where v points down", "[texture_transform]") {
    const TextureTransform turn{.rotation_rad = quarter};
    check_same(turn.apply({1, 0}), {0, -1});
    check_same(turn.apply({0, 1}), {1, 0});
}

TEST_CASE("coordinates are scaled before they are rotated, and moved last", "[texture_transform]") {
    const TextureTransform all{.offset = {10, 20}, .rotation_rad = quarter, .scale = {2, 3}};
    // (1, 1) → (2, 3) → (3, -2) → (13, 18)
    check_same(all.apply({1, 1}), {13, 18});
    const TextureTransform flip{.offset = {0, 1}, .scale = {1, -1}};
    check_same(flip.apply({0.25f, 0.25f}), {0.25f, 0.75f});
}

TEST_CASE("a huge rotation is one like any other", "[texture_transform]") {
    const TextureTransform spun{.rotation_rad = std::numeric_limits<float>::max()};
    const glm::vec2 turned = spun.apply({3, 4});
    CHECK(std::hypot(turned.x, turned.y) == Approx(5.0f));
}
