// Whether a clip looks the same at two times.

#include "anim/repeats.h"
#include "scene_builder.h"

#include <catch2/catch.hpp>

namespace gridreel::anim {
namespace {

using testing::keys;

/// One node whose property on `path` has three keys, at 0, 1 and 2 s.
bool is_loop(ChannelPath path, std::uint32_t width, std::vector<float> values,
             Interpolation interpolation = Interpolation::linear) {
    Scene scene = testing::empty_scene();
    testing::add_node(scene, {});
    testing::drive(scene, testing::add_animation(scene), 0, path,
                   keys(interpolation, width, {0, 1, 2}, std::move(values)));
    return repeats(scene, choose_clip(scene), 0.0, 2.0);
}

TEST_CASE("a property that comes back is the same at both ends", "[anim]") {
    CHECK(is_loop(ChannelPath::translation, 3, {1, 2, 3, 9, 9, 9, 1, 2, 3}));
    CHECK(is_loop(ChannelPath::translation, 3, {1, 2, 3, 9, 9, 9, 1, 2, 3.00002f}));
    CHECK_FALSE(is_loop(ChannelPath::translation, 3, {1, 2, 3, 9, 9, 9, 1, 2, 3.001f}));
    CHECK_FALSE(is_loop(ChannelPath::translation, 3, {0, 0, 0, 1e-6f, 0, 0, 2e-6f, 0, 0}));
}

TEST_CASE("each number is held against its own keys", "[anim]") {
    CHECK_FALSE(is_loop(ChannelPath::translation, 3, {10000, 0, 0, 10000, 1, 0, 10000, 0.09f, 0}));
    CHECK(is_loop(ChannelPath::translation, 3, {10000, 0, 0, 10000, 1, 0, 10000.001f, 0, 0}));
}

TEST_CASE("tangents of splines are no keys", "[anim]") {
    const auto spline = [](float last) { return std::vector<float>{0, 0, 1000, 0, 0, 0, 1000, last, 0}; };
    CHECK(is_loop(ChannelPath::weights, 1, spline(0), Interpolation::cubic_spline));
    CHECK_FALSE(is_loop(ChannelPath::weights, 1, spline(0.005f), Interpolation::cubic_spline));
}

TEST_CASE("a turn and its negative quaternion are the same", "[anim]") {
    CHECK(is_loop(ChannelPath::rotation, 4, {0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, -1}));
    CHECK_FALSE(is_loop(ChannelPath::rotation, 4, {0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0}));
}

TEST_CASE("flags are compared as flags", "[anim]") {
    CHECK(is_loop(ChannelPath::visibility, 1, {1, 0, 255}, Interpolation::step));
    CHECK_FALSE(is_loop(ChannelPath::visibility, 1, {1, 0, 0}, Interpolation::step));
}

TEST_CASE("a still repeats itself", "[anim]") {
    const Scene scene = testing::empty_scene();
    CHECK(repeats(scene, choose_clip(scene), 0.0, 7.0));
}

}  // namespace
}  // namespace gridreel::anim
