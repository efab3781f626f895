#include "engine/texture.h"

#include "engine/srgb.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace gridreel;
using anim::Filter;
using anim::MipFilter;
using anim::Wrap;
using engine::Encoding;

namespace {

constexpr std::uint16_t full = 65535;

/// Top row black, white; bottom row red, half-transparent green.
engine::Pyramid four_texels() {
    return {{.width = 2,
             .height = 2,
             .texels = {{0, 0, 0, full}, {full, full, full, full}, {full, 0, 0, full}, {0, full, 0, 32768}}},
            Encoding::linear};
}

anim::Texture sampler(Wrap wrap, Filter filter, MipFilter mip = MipFilter::none) {
    return {.image = 0,
            .wrap_s = wrap,
            .wrap_t = wrap,
            .mag_filter = filter,
            .min_filter = filter,
            .mip_filter = mip};
}

/// One row of two texels, black and white, under `wrap`; its red value at `u`.
float red_at(float u, Wrap wrap, Filter filter) {
    const engine::Pyramid image(
        {.width = 2, .height = 1, .texels = {{0, 0, 0, full}, {full, full, full, full}}}, Encoding::linear);
    return engine::sample(image, sampler(wrap, filter), {u, 0.5f}, 0.0f).x;
}

void check_color(const glm::vec4& color, const glm::vec4& expected) {
    for (int i = 0; i < 4; ++i) CHECK(color[i] == Approx(expected[i]).margin(2e-5));
}

}  // namespace

TEST_CASE("texture coordinates start at the top left", "[engine]") {
    const engine::Pyramid image = four_texels();
    const anim::Texture nearest = sampler(Wrap::repeat, Filter::nearest);
    check_color(engine::sample(image, nearest, {0.25f, 0.25f}, 0.0f), {0, 0, 0, 1});
    check_color(engine::sample(image, nearest, {0.75f, 0.25f}, 0.0f), {1, 1, 1, 1});
    check_color(engine::sample(image, nearest, {0.25f, 0.75f}, 0.0f), {1, 0, 0, 1});
    check_color(engine::sample(image, nearest, {0.75f, 0.75f}, 0.0f), {0, 1, 0, 32768.0f / 65535.0f});
}

TEST_CASE("linear filtering weighs the four texels around", "[engine]") {
    const engine::Pyramid image = four_texels();
    const anim::Texture linear = sampler(Wrap::clamp_to_edge, Filter::linear);
    check_color(engine::sample(image, linear, {0.25f, 0.25f}, 0.0f), {0, 0, 0, 1});
    check_color(engine::sample(image, linear, {0.5f, 0.25f}, 0.0f), {0.5f, 0.5f, 0.5f, 1});
    check_color(engine::sample(image, linear, {0.375f, 0.25f}, 0.0f), {0.25f, 0.25f, 0.25f, 1});
    check_color(engine::sample(image, linear, {0.5f, 0.5f}, 0.0f), {0.5f, 0.5f, 0.25f, 0.875f});
}

TEST_CASE("nearest filtering wraps as the sampler says", "[engine]") {
    // Columns outside the image: … 0 1 | 0 1 | 0 1 …, … 1 0 | 0 1 | 1 0 …, … 0 0 | 0 1 | 1 1 …
    CHECK(red_at(-0.25f, Wrap::repeat, Filter::nearest) == 1.0f);
    CHECK(red_at(1.25f, Wrap::repeat, Filter::nearest) == 0.0f);
    CHECK(red_at(-0.25f, Wrap::mirrored_repeat, Filter::nearest) == 0.0f);
    CHECK(red_at(-0.75f, Wrap::mirrored_repeat, Filter::nearest) == 1.0f);
    CHECK(red_at(1.25f, Wrap::mirrored_repeat, Filter::nearest) == 1.0f);
    CHECK(red_at(1.75f, Wrap::mirrored_repeat, Filter::nearest) == 0.0f);
    CHECK(red_at(2.25f, Wrap::mirrored_repeat, Filter::nearest) == 0.0f);
    CHECK(red_at(-7.0f, Wrap::clamp_to_edge, Filter::nearest) == 0.0f);
    CHECK(red_at(1.0f, Wrap::clamp_to_edge, Filter::nearest) == 1.0f);
    CHECK(red_at(7.0f, Wrap::clamp_to_edge, Filter::nearest) == 1.0f);
}

TEST_CASE("linear filtering wraps as the sampler says", "[engine]") {
    CHECK(red_at(0.0f, Wrap::repeat, Filter::linear) == Approx(0.5f));
    CHECK(red_at(1.0f, Wrap::repeat, Filter::linear) == Approx(0.5f));
    CHECK(red_at(0.125f, Wrap::repeat, Filter::linear) == Approx(0.25f));
    CHECK(red_at(0.0f, Wrap::mirrored_repeat, Filter::linear) == 0.0f);
    CHECK(red_at(1.0f, Wrap::mirrored_repeat, Filter::linear) == 1.0f);
    CHECK(red_at(1.5f, Wrap::mirrored_repeat, Filter::linear) == Approx(0.5f));
    CHECK(red_at(0.0f, Wrap::clamp_to_edge, Filter::linear) == 0.0f);
    CHECK(red_at(0.95f, Wrap::clamp_to_edge, Filter::linear) == 1.0f);
}

TEST_CASE("coordinates that are no numbers or very large read some texel", "[engine]") {
    const engine::Pyramid image = four_texels();
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
        for (const Filter filter : {Filter::nearest, Filter::linear}) {
            for (const float u :
                 {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f,
                  -1e30f, -1e-30f, std::nextafter(1.0f, 0.0f)}) {
                const glm::vec4 color = engine::sample(image, sampler(wrap, filter), {u, u}, 0.0f);
                for (int i = 0; i < 4; ++i) CHECK((color[i] >= 0.0f && color[i] <= 1.0f));
            }
        }
    }
}

TEST_CASE("smaller sizes average the area of larger ones, in linear light", "[engine]") {
    // sRGB black and white: the average is 0.5 of the light, not of the code.
    const engine::Pyramid image({.width = 2, .height = 1, .texels = {{0, 0, 0, 0}, {full, full, full, full}}},
                                Encoding::srgb);
    REQUIRE(image.levels.size() == 2);
    CHECK(image.levels[1].width == 1);
    CHECK(image.levels[1].height == 1);
    CHECK(static_cast<int>(image.levels[1].texels[0].x) == Approx(32768).margin(1));
}

TEST_CASE("an odd side halves to texels of equal area", "[engine]") {
    // Five texels onto two: each covers 2.5 of them.
    const engine::Pyramid image(
        {.width = 5,
         .height = 1,
         .texels = {{0, 0, 0, 0}, {10000, 0, 0, 0}, {20000, 0, 0, 0}, {30000, 0, 0, 0}, {40000, 0, 0, 0}}},
        Encoding::linear);
    REQUIRE(image.levels.size() == 3);
    CHECK(static_cast<int>(image.levels[1].texels[0].x) == Approx((0 + 10000 + 0.5 * 20000) / 2.5).margin(1));
    CHECK(static_cast<int>(image.levels[1].texels[1].x) ==
          Approx((0.5 * 20000 + 30000 + 40000) / 2.5).margin(1));
    CHECK(static_cast<int>(image.levels[2].texels[0].x) == Approx(20000).margin(1));
}

TEST_CASE("the footprint chooses the size", "[engine]") {
    // Black and white columns of a 4 x 4 image: grey from the second size on.
    engine::DecodedImage columns{.width = 4, .height = 4, .texels = {}};
    for (int i = 0; i < 16; ++i) {
        const auto value = static_cast<std::uint16_t>(i % 2 == 0 ? 0 : 60000);
        columns.texels.emplace_back(value, value, value, full);
    }
    const engine::Pyramid image(columns, Encoding::linear);
    const float white = 60000.0f / 65535.0f;
    const glm::vec2 on_white{0.375f, 0.375f};

    const anim::Texture none = sampler(Wrap::repeat, Filter::nearest, MipFilter::none);
    CHECK(engine::sample(image, none, on_white, 1.0f).x == Approx(white));
    const anim::Texture nearest = sampler(Wrap::repeat, Filter::nearest, MipFilter::nearest);
    CHECK(engine::sample(image, nearest, on_white, 0.25f).x == Approx(white));
    CHECK(engine::sample(image, nearest, on_white, 0.25f * 1.4f).x == Approx(white));
    CHECK(engine::sample(image, nearest, on_white, 0.25f * 1.5f).x == Approx(white / 2).margin(2e-5));
    const anim::Texture linear = sampler(Wrap::repeat, Filter::nearest, MipFilter::linear);
    CHECK(engine::sample(image, linear, on_white, 0.25f * std::sqrt(2.0f)).x ==
          Approx(0.75f * white).margin(2e-5));
    CHECK(engine::sample(image, linear, on_white, 1e9f).x == Approx(white / 2).margin(2e-5));
}

TEST_CASE("magnification and minification each have their filter", "[engine]") {
    const engine::Pyramid image = four_texels();
    const anim::Texture mixed{.image = 0,
                              .wrap_s = Wrap::repeat,
                              .wrap_t = Wrap::repeat,
                              .mag_filter = Filter::nearest,
                              .min_filter = Filter::linear,
                              .mip_filter = MipFilter::none};
    check_color(engine::sample(image, mixed, {0.45f, 0.25f}, 0.1f), {0, 0, 0, 1});
    check_color(engine::sample(image, mixed, {0.5f, 0.25f}, 0.9f), {0.5f, 0.5f, 0.5f, 1});
}
