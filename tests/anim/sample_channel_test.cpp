// Interpolation between keys, against numbers worked out by hand from glTF 2.0, appendix C.

#include "anim/sample_channel.h"

#include "scene_builder.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

namespace gridreel::anim {
namespace {

using testing::keys;

constexpr float half_root = 0.70710678f;  // sin 45 = cos 45

void check_vec3(const glm::dvec3& value, const glm::dvec3& expected, double tolerance = 1e-12) {
    CAPTURE(value.x, value.y, value.z);
    CHECK(testing::distance(value, expected) <= tolerance);
}

/// The same components, signs included, and unit length.
void check_rotation(const glm::dquat& value, const glm::dquat& expected, double tolerance = 1e-7) {
    CAPTURE(value.x, value.y, value.z, value.w);
    CHECK(std::abs(glm::length(value) - 1.0) < 1e-12);
    CHECK(glm::length(value - expected) <= tolerance);
}

glm::dquat about_z(double degrees) {
    const double half = glm::radians(degrees) / 2.0;
    return {std::cos(half), 0.0, 0.0, std::sin(half)};
}

TEST_CASE("step holds a key until the next one", "[anim]") {
    const Sampler sampler = keys(Interpolation::step, 3, {1, 2, 4}, {1, 2, 3, 4, 5, 6, 7, 8, 9});

    check_vec3(sample_vec3(sampler, 1.0), {1, 2, 3});
    check_vec3(sample_vec3(sampler, 1.999), {1, 2, 3});
    check_vec3(sample_vec3(sampler, 2.0), {4, 5, 6});
    check_vec3(sample_vec3(sampler, 3.999), {4, 5, 6});
    check_vec3(sample_vec3(sampler, 4.0), {7, 8, 9});
}

TEST_CASE("linear keys are joined by straight lines", "[anim]") {
    const Sampler sampler = keys(Interpolation::linear, 3, {0, 2, 3}, {0, 10, -4, 8, 10, 4, 9, 0, 0});

    check_vec3(sample_vec3(sampler, 0.5), {2, 10, -2});
    check_vec3(sample_vec3(sampler, 2.0), {8, 10, 4});
    check_vec3(sample_vec3(sampler, 2.25), {8.25, 7.5, 3});
}

TEST_CASE("a cubic spline follows Hermite's formula with tangents per second", "[anim]") {
    // The interval is 2 s. The outermost tangents lead nowhere and must not count.
    // u = 1/2: 1 * 1/2 + 2 * 4 * 1/8 + 11 * 1/2 - 2 * (-2) * 1/8 = 7.5
    // u = 1/4: 1 * 27/32 + 2 * 4 * 9/64 + 11 * 5/32 - 2 * (-2) * 3/64 = 3.875
    const Sampler sampler = keys(Interpolation::cubic_spline, 3, {1, 3},
                                 {1e6f, 1e6f, 1e6f, 1, 0, 1, 4, 0, 0,  //
                                  -2, 0, 0, 11, 0, 3, 1e6f, 1e6f, 1e6f});

    check_vec3(sample_vec3(sampler, 1.0), {1, 0, 1});
    check_vec3(sample_vec3(sampler, 1.5), {3.875, 0, 1.3125});
    check_vec3(sample_vec3(sampler, 2.0), {7.5, 0, 2});
    check_vec3(sample_vec3(sampler, 3.0), {11, 0, 3});
}

TEST_CASE("the ends are held before the first key and after the last", "[anim]") {
    const auto interpolation =
        GENERATE(Interpolation::step, Interpolation::linear, Interpolation::cubic_spline);
    const bool cubic = interpolation == Interpolation::cubic_spline;
    const Sampler sampler =
        keys(interpolation, 3, {1, 2},
             cubic ? std::vector<float>{9, 9, 9, 1, 2, 3, 9, 9, 9, 9, 9, 9, 4, 5, 6, 9, 9, 9}
                   : std::vector<float>{1, 2, 3, 4, 5, 6});

    check_vec3(sample_vec3(sampler, -5.0), {1, 2, 3});
    check_vec3(sample_vec3(sampler, 0.0), {1, 2, 3});
    check_vec3(sample_vec3(sampler, 2.0), {4, 5, 6});
    check_vec3(sample_vec3(sampler, 1e9), {4, 5, 6});
}

TEST_CASE("a single key holds always", "[anim]") {
    const auto interpolation =
        GENERATE(Interpolation::step, Interpolation::linear, Interpolation::cubic_spline);
    const bool cubic = interpolation == Interpolation::cubic_spline;
    const Sampler sampler =
        keys(interpolation, 3, {1},
             cubic ? std::vector<float>{9, 9, 9, 1, 2, 3, 9, 9, 9} : std::vector<float>{1, 2, 3});

    check_vec3(sample_vec3(sampler, 0.0), {1, 2, 3});
    check_vec3(sample_vec3(sampler, 1.0), {1, 2, 3});
    check_vec3(sample_vec3(sampler, 7.0), {1, 2, 3});
    CHECK_FALSE(varies(sampler));
}

TEST_CASE("linear rotations turn with constant speed", "[anim]") {
    const Sampler sampler = keys(Interpolation::linear, 4, {0, 3}, {0, 0, 0, 1, 0, 0, half_root, half_root});

    check_rotation(sample_rotation(sampler, 1.0), about_z(30.0));
    check_rotation(sample_rotation(sampler, 2.0), about_z(60.0));
    check_rotation(sample_rotation(sampler, 3.0), about_z(90.0));
}

TEST_CASE("linear rotations take the shorter way round", "[anim]") {
    // The second key is 90 degrees about z, written as its negative: the long way would be 270 degrees.
    const Sampler sampler =
        keys(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, -half_root, -half_root});

    check_rotation(sample_rotation(sampler, 0.5), about_z(45.0));
    check_rotation(sample_rotation(sampler, 1.0 / 3.0), about_z(30.0));
}

TEST_CASE("linear rotations half a turn apart pass through a quarter turn", "[anim]") {
    const Sampler sampler = keys(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});

    check_rotation(sample_rotation(sampler, 0.5), about_z(90.0));
}

TEST_CASE("rotations that are nearly or exactly the same stay finite and unit", "[anim]") {
    const float tiny = GENERATE(0.0f, 1e-30f, 1e-10f, 1e-8f, 1e-6f);
    const float sign = GENERATE(1.0f, -1.0f);
    const Sampler sampler = keys(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, sign * tiny, sign * 1});

    check_rotation(sample_rotation(sampler, 0.25), {1.0, 0.0, 0.0, 0.25 * double(tiny)}, 1e-12);
}

TEST_CASE("rotation keys that are a little off unit length give unit rotations", "[anim]") {
    // 90/127 is how a signed byte writes sin 45.
    const float eighth = 90.0f / 127.0f;
    const auto interpolation = GENERATE(Interpolation::step, Interpolation::linear);
    const Sampler sampler =
        keys(interpolation, 4, {0, 1, 2}, {0, 0, 0, 1, 0, 0, eighth, eighth, 0, 0, eighth, eighth});

    check_rotation(sample_rotation(sampler, 1.0), about_z(90.0), 1e-12);
    check_rotation(sample_rotation(sampler, 1.5), about_z(90.0), 1e-12);
    CHECK(std::abs(glm::length(sample_rotation(sampler, 0.3)) - 1.0) < 1e-12);
}

TEST_CASE("rotation keys are interpolated as they stand and normalised afterwards", "[anim]") {
    // Much too short a second key, to make it show: the formula sees an angle of arccos 0.5 = 60 degrees, so
    // both keys weigh sin 30 / sin 60 = 0.57735 half way: (0, 0, 0.288675, 0.866025), 0.912871 long.
    const Sampler sampler = keys(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, 0.5f, 0.5f});

    check_rotation(sample_rotation(sampler, 0.5), {0.948683, 0.0, 0.0, 0.316228}, 1e-6);
}

TEST_CASE("cubic rotations are splines of components, normalised", "[anim]") {
    // With zero tangents the second key weighs 1/2 at u = 1/2 and 5/32 at u = 1/4. At 1/4 that is
    // z = 0.110485, w = 0.954235 before the division by their length, 0.960610.
    const Sampler sampler =
        keys(Interpolation::cubic_spline, 4, {0, 1}, {0, 0, 0, 0, 0, 0, 0,         1,         0, 0, 0, 0,  //
                                                      0, 0, 0, 0, 0, 0, half_root, half_root, 0, 0, 0, 0});
    check_rotation(sample_rotation(sampler, 0.5), about_z(45.0));
    check_rotation(sample_rotation(sampler, 0.25), {0.993364, 0.0, 0.0, 0.115016}, 1e-6);

    // An out-tangent of 2 in x adds 2 * 1/8: (1/4, 0, 0, 1) over its length, 1.030776.
    const Sampler leaning =
        keys(Interpolation::cubic_spline, 4, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0,  //
                                                      0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0});
    check_rotation(sample_rotation(leaning, 0.5), {0.970143, 0.242536, 0.0, 0.0}, 1e-6);
}

TEST_CASE("a rotation of zeros is the identity", "[anim]") {
    const Sampler sampler = keys(Interpolation::linear, 4, {0}, {0, 0, 0, 0});

    check_rotation(sample_rotation(sampler, 0.0), {1.0, 0.0, 0.0, 0.0}, 0.0);
}

TEST_CASE("morph weights of a key stand side by side", "[anim]") {
    std::array<float, 2> weights{};

    const Sampler linear = keys(Interpolation::linear, 2, {0, 1}, {0, 1, 1, 0.5f});
    sample_numbers(linear, 0.5, weights);
    CHECK(weights == std::array{0.5f, 0.75f});

    // Cubic: both in-tangents, both values, both out-tangents. u = 1/2 as above, interval 1 s:
    // 0.5 * 0 + 8/8 + 0.5 * 1 - 0 = 1.5 and 0.5 * 2 + 0 + 0.5 * 4 - 16/8 = 1.
    const Sampler cubic = keys(Interpolation::cubic_spline, 2, {0, 1},
                               {0, 0, 0, 2, 8, 0,  //
                                0, 16, 1, 4, 0, 0});
    sample_numbers(cubic, 0.5, weights);
    CHECK(weights == std::array{1.5f, 1.0f});
}

TEST_CASE("equal keys do not vary, and give the same bits at every time", "[anim]") {
    const auto interpolation = GENERATE(Interpolation::step, Interpolation::linear);
    const Sampler rotation = keys(interpolation, 4, {0, 1, 2},
                                  {0.1f, 0.2f, 0.3f, 0.9f, 0.1f, 0.2f, 0.3f, 0.9f, 0.1f, 0.2f, 0.3f, 0.9f});
    CHECK_FALSE(varies(rotation));
    const glm::dquat first = sample_rotation(rotation, 0.0);
    for (const double time_s : {0.1, 0.3, 0.7, 1.0, 1.9, 2.0}) {
        CHECK(sample_rotation(rotation, time_s) == first);
    }

    const Sampler cubic = keys(Interpolation::cubic_spline, 3, {0, 1},
                               {0, 0, 0, 0.1f, 0.2f, 0.3f, 0, 0, 0, 0, 0, 0, 0.1f, 0.2f, 0.3f, 0, 0, 0});
    CHECK_FALSE(varies(cubic));
    for (const double time_s : {0.1, 0.3, 0.7}) {
        CHECK(sample_vec3(cubic, time_s) == sample_vec3(cubic, 0.0));
    }
}

TEST_CASE("unequal keys, or equal ones with tangents, vary", "[anim]") {
    CHECK(varies(keys(Interpolation::step, 3, {0, 1}, {0, 0, 0, 0, 0, 1})));
    CHECK(varies(keys(Interpolation::linear, 3, {0, 1}, {0, 0, 0, 1, 0, 0})));
    CHECK(varies(keys(Interpolation::cubic_spline, 1, {0, 1}, {0, 5, 1, 0, 5, 0})));
}

}  // namespace
}  // namespace gridreel::anim
