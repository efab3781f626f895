// Morph targets: shapes before joints and nodes place them.

#include "anim/frame_geometry.h"

#include "scene_builder.h"

#include <catch2/catch.hpp>

namespace gridreel::anim {
namespace {

using testing::add_animation;
using testing::add_mesh;
using testing::add_node;
using testing::distance;
using testing::drive;
using testing::frame_at;
using testing::moved;
using testing::placed;
using testing::scaled;
using testing::shift;
using testing::triangle;
using testing::turned;

/// A triangle whose targets push all corners along +x and along +z.
Primitive pushed_triangle() {
    Primitive primitive = triangle();
    primitive.targets = {shift({{1, 0, 0}, {1, 0, 0}, {2, 0, 0}}), shift({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}})};
    return primitive;
}

TEST_CASE("targets add their weighted displacements", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index mesh = add_mesh(scene, pushed_triangle());
    const auto weights = GENERATE(std::vector{0.0f, 0.0f}, std::vector{0.5f, 0.0f}, std::vector{0.0f, 1.0f},
                                  std::vector{2.0f, -0.25f});
    Node node = placed({}, mesh);
    node.weights = weights;
    add_node(scene, node);
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(distance(frame.positions[0], glm::vec3{weights[0], 0, weights[1]}) < 1e-6);
    CHECK(distance(frame.positions[1], glm::vec3{1 + weights[0], 0, 2 * weights[1]}) < 1e-6);
    CHECK(distance(frame.positions[2], glm::vec3{2 * weights[0], 1, 3 * weights[1]}) < 1e-6);
}

TEST_CASE("a mesh in two nodes has each node's own shape", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index mesh = add_mesh(scene, pushed_triangle(), {1.0f, 0.0f});
    add_node(scene, placed({}, mesh));
    add_node(scene, placed({}, mesh));
    scene.nodes[1].weights = {0.0f, 1.0f};
    add_node(scene, placed({}, mesh));
    drive(scene, add_animation(scene), 2, ChannelPath::weights,
          testing::keys(Interpolation::linear, 2, {0, 2}, {0, 0, 1, 4}));
    const FrameGeometry frame = frame_at(scene, 0.5);

    CHECK(distance(frame.positions[0], glm::vec3{1, 0, 0}) < 1e-6);
    CHECK(distance(frame.positions[3], glm::vec3{0, 0, 1}) < 1e-6);
    CHECK(distance(frame.positions[6], glm::vec3{0.25f, 0, 1}) < 1e-6);
}

TEST_CASE("normals and tangents are morphed, then normalised", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = triangle();
    primitive.tangents.assign(3, {1, 0, 0, -1});
    primitive.targets.resize(1);
    primitive.targets[0].normals.assign(3, {1.5f, 0, 0});
    primitive.targets[0].tangents.assign(3, {0, 0, -1.5f});
    add_node(scene, placed({}, add_mesh(scene, primitive, {0.5f})));
    const FrameGeometry frame = frame_at(scene, 0.0);

    // (0.75, 0, 1) is 1.25 long.
    CHECK(distance(frame.normals[1], glm::vec3{0.6f, 0, 0.8f}) < 1e-6);
    CHECK(distance(frame.tangents[1], glm::vec4{0.8f, 0, -0.6f, -1}) < 1e-6);
    CHECK(distance(frame.positions[1], glm::vec3{1, 0, 0}) < 1e-6);
}

TEST_CASE("targets may displace only some attributes", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = triangle();
    primitive.targets.resize(2);
    primitive.targets[0].normals.assign(3, {0, 1, -1});
    primitive.targets[1].positions.assign(3, {0, 0, 5});
    add_node(scene, placed({}, add_mesh(scene, primitive, {1.0f, 1.0f})));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(distance(frame.positions[1], glm::vec3{1, 0, 5}) < 1e-6);
    CHECK(distance(frame.normals[1], glm::vec3{0, 1, 0}) < 1e-6);
}

TEST_CASE("the displaced normals of a part without normals do not count", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = triangle();
    primitive.normals.clear();
    primitive.targets.resize(1);
    primitive.targets[0].normals.assign(3, {0, 1, 0});
    add_node(scene, placed({}, add_mesh(scene, primitive, {1.0f})));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK_FALSE(frame.parts[0].smooth);
    CHECK(frame.normals[0] == glm::vec3{0.0f});
}

TEST_CASE("shapes morph before their node places them", "[anim]") {
    Scene scene = testing::empty_scene();
    Trs trs = scaled(2, 2, 2);
    trs.translation = {10, 0, 0};
    add_node(scene, placed(trs, add_mesh(scene, pushed_triangle(), {1.0f, 0.0f})));

    CHECK(distance(frame_at(scene, 0.0).positions[1], glm::vec3{14, 0, 0}) < 1e-6);
}

TEST_CASE("shapes morph before their joints place them", "[anim]") {
    // The second corner is pushed from x = 1 to x = 2, then swung round to y = 2. Skinned first, it
    // would stand at (1, 1, 0).
    Scene scene = testing::empty_scene();
    const Index joint = add_node(scene, placed(turned(90.0, {0, 0, 1})));
    Primitive primitive = pushed_triangle();
    testing::bind(primitive, {0, 0, 0, 0}, {1, 0, 0, 0});
    Node node = placed(moved(7, 7, 7), add_mesh(scene, primitive, {1.0f, 0.0f}));
    node.skin = testing::add_skin(scene, {joint});
    add_node(scene, node);

    CHECK(distance(frame_at(scene, 0.0).positions[1], glm::vec3{0, 2, 0}) < 1e-6);
}

TEST_CASE("morphed normals go through the joints as well", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index joint = add_node(scene, placed(turned(90.0, {0, 0, 1})));
    Primitive primitive = triangle();
    primitive.targets.resize(1);
    primitive.targets[0].normals.assign(3, {2, 0, -1});
    testing::bind(primitive, {0, 0, 0, 0}, {1, 0, 0, 0});
    Node node = placed({}, add_mesh(scene, primitive, {1.0f}));
    node.skin = testing::add_skin(scene, {joint});
    add_node(scene, node);

    CHECK(distance(frame_at(scene, 0.0).normals[0], glm::vec3{0, 1, 0}) < 1e-6);
}

TEST_CASE("a morphing mesh that is far from its file's origin keeps its digits", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = testing::points({{1e6f, 0, 0}, {1e6f + 1, 1, 1}});
    primitive.targets = {shift({{0.1f, 0.2f, 0.3f}, {0, 0, 0}})};
    add_node(scene, placed(moved(-1e6, 0, 0), add_mesh(scene, primitive, {1.0f})));

    CHECK(distance(frame_at(scene, 0.0).positions[0], glm::vec3{0.1f, 0.2f, 0.3f}) < 1e-6);
}

}  // namespace
}  // namespace gridreel::anim
