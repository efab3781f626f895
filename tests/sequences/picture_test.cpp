#include "sequences/picture.h"

#include "engine/srgb.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace gridreel;
using namespace gridreel::sequences;

namespace {

engine::Film one_pixel(std::vector<float> channels) {
    engine::Film film;
    film.resize(1, 1);
    film.pixels = std::move(channels);
    return film;
}

template <class T>
T value_at(const Picture& picture, std::size_t byte) {
    T value{};
    std::memcpy(&value, picture.pixels.data() + byte, sizeof value);
    return value;
}

/// The 8-bit code by the standard's formula, slowly.
int srgb_by_formula(double linear) {
    const double encoded = linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<int>(std::floor(encoded * 255.0 + 0.5));
}

constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("half pictures hold the bits of IEEE half precision", "[picture]") {
    Picture picture;
    store(one_pixel({1.0f, 0.5f, -2.0f, 0.0f, 9, 9, 9, 9}), {}, picture);
    REQUIRE(picture.channels.size() == 4);
    REQUIRE(picture.pixels.size() == 8);
    CHECK(value_at<std::uint16_t>(picture, 0) == 0x3c00);
    CHECK(value_at<std::uint16_t>(picture, 2) == 0x3800);
    CHECK(value_at<std::uint16_t>(picture, 4) == 0xc000);
    CHECK(value_at<std::uint16_t>(picture, 6) == 0x0000);
}

TEST_CASE("what half precision cannot hold becomes its largest number", "[picture]") {
    Picture picture;
    store(one_pixel({1e6f, infinity, -1e6f, 1.0f, 9, 9, 9, 9}), {}, picture);
    CHECK(value_at<std::uint16_t>(picture, 0) == 0x7bff);
    CHECK(value_at<std::uint16_t>(picture, 2) == 0x7bff);
    CHECK(value_at<std::uint16_t>(picture, 4) == 0xfbff);
}

TEST_CASE("extra channels follow the colour, Z always in single precision", "[picture]") {
    Picture picture;
    store(one_pixel({1, 1, 1, 1, infinity, 0.25f, 0.5f, 1.0f}), {.aov_z = true, .aov_n = true}, picture);
    std::vector<std::string> names;
    for (const auto& channel : picture.channels) names.push_back(channel.name);
    CHECK(names == std::vector<std::string>{"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z"});
    REQUIRE(picture.pixels.size() == 4 * 2 + 4 + 3 * 2);
    CHECK(value_at<float>(picture, 8) == infinity);
    CHECK(value_at<std::uint16_t>(picture, 12) == 0x3400);
    CHECK(value_at<std::uint16_t>(picture, 16) == 0x3c00);

    store(one_pixel({1, 1, 1, 1, 3.5f, 0.1f, 0, 1}),
          {.depth = Depth::single_float, .aov_z = true, .aov_n = true}, picture);
    REQUIRE(picture.pixels.size() == 8 * 4);
    CHECK(value_at<float>(picture, 20) == 0.1f);
}

TEST_CASE("PNG pixels have straight alpha on the sRGB curve", "[picture]") {
    Picture picture;
    // Half-covered grey of linear 0.2140: premultiplied 0.1070. 0.2140 is code 127.5 + 0.4 or so.
    store(one_pixel({0.10706f, 0.0f, 0.5f, 0.5f, 9, 9, 9, 9}), {.format = ImageFormat::png}, picture);
    REQUIRE(picture.pixels.size() == 4);
    CHECK(value_at<std::uint8_t>(picture, 0) == srgb_by_formula(0.21412));
    CHECK(value_at<std::uint8_t>(picture, 1) == 0);
    CHECK(value_at<std::uint8_t>(picture, 2) == 255);
    CHECK(value_at<std::uint8_t>(picture, 3) == 128);

    store(one_pixel({0.3f, 0.3f, 0.3f, 0.0f, 9, 9, 9, 9}), {.format = ImageFormat::png}, picture);
    for (std::size_t i = 0; i < 4; ++i) CHECK(value_at<std::uint8_t>(picture, i) == 0);
}

TEST_CASE("the sRGB table agrees with the formula everywhere", "[picture]") {
    CHECK(srgb_byte(0.0f) == 0);
    CHECK(srgb_byte(1.0f) == 255);
    CHECK(srgb_byte(-1.0f) == 0);
    CHECK(srgb_byte(7.0f) == 255);
    CHECK(srgb_byte(infinity) == 255);
    CHECK(srgb_byte(std::nanf("")) == 0);
    CHECK(srgb_byte(0.2158605f) == 128);  // 128/255 decoded
    int wrong = 0;
    for (int i = 0; i <= 200'000; ++i) {
        const float linear = float(i) / 200'000.0f;
        wrong += srgb_byte(linear) != srgb_by_formula(double(linear) * (1 - 1e-6)) &&
                 srgb_byte(linear) != srgb_by_formula(double(linear) * (1 + 1e-6));
    }
    CHECK(wrong == 0);
    // And every code comes back from its own decoded value.
    for (int code = 0; code < 256; ++code)
        CHECK(srgb_byte(engine::linear_from_srgb(float(code) / 255.0f)) == code);
}
