// The box that a camera has to see.

#include "anim/clip_bounds.h"

#include "scene_builder.h"

#include <catch2/catch.hpp>

#include <limits>

namespace gridreel::anim {
namespace {

using testing::add_animation;
using testing::add_mesh;
using testing::add_node;
using testing::drive;
using testing::keys;
using testing::moved;
using testing::placed;
using testing::triangle;

TEST_CASE("a still has the box of its triangles", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index mesh = add_mesh(scene, triangle());
    add_node(scene, placed(moved(1, 2, 3), mesh));
    add_node(scene, placed(moved(-1, 0, 0), mesh));

    CHECK(clip_bounds(scene, choose_clip(scene)) == Box{.min = {-1, 0, 0}, .max = {2, 3, 3}});
}

TEST_CASE("a clip has the box of all its times, both ends included", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, placed({}, add_mesh(scene, triangle())));
    drive(scene, add_animation(scene), 0, ChannelPath::translation,
          keys(Interpolation::linear, 3, {1, 2, 3}, {-5, 0, 0, 0, 0, 0, 0, 7, 0}));

    const Clip clip = choose_clip(scene);
    CHECK(clip_bounds(scene, clip) == Box{.min = {-5, 0, 0}, .max = {1, 8, 0}});
    CHECK(clip_bounds(scene, choose_clip(scene, "none")) == Box{.min = {0, 0, 0}, .max = {1, 1, 0}});
}

TEST_CASE("the middle of a clip counts", "[anim]") {
    // Out to x = 31 and back again; a sample falls within a 31st of the turning point.
    Scene scene = testing::empty_scene();
    add_node(scene, placed({}, add_mesh(scene, triangle())));
    drive(scene, add_animation(scene), 0, ChannelPath::translation,
          keys(Interpolation::linear, 3, {0, 1, 2}, {0, 0, 0, 31, 0, 0, 0, 0, 0}));
    const Box box = clip_bounds(scene, choose_clip(scene));

    CHECK(box.max.x == Approx(31.0));  // 30 at the samples nearest to it, and 1 for the triangle
    CHECK(box.min.x == 0.0f);
}

TEST_CASE("vertices that no triangle uses do not count, nor do those at infinity", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = triangle();
    primitive.positions.emplace_back(1000, 1000, 1000);
    primitive.positions.emplace_back(std::numeric_limits<float>::infinity(), 0, 0);
    primitive.triangles.emplace_back(0, 1, 4);
    primitive.normals.clear();
    add_node(scene, placed({}, add_mesh(scene, primitive)));

    CHECK(clip_bounds(scene, choose_clip(scene)) == Box{.min = {0, 0, 0}, .max = {1, 1, 0}});
}

TEST_CASE("a scene without triangles has an empty box", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, placed({}, add_mesh(scene, testing::points({{1, 2, 3}}))));

    CHECK(clip_bounds(scene, choose_clip(scene)).empty());
}

}  // namespace
}  // namespace gridreel::anim
