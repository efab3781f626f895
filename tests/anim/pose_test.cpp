// World matrices and morph weights at one time.

#include "anim/pose.h"

#include "scene_builder.h"

#include <catch2/catch.hpp>

namespace gridreel::anim {
namespace {

using testing::add_animation;
using testing::add_node;
using testing::distance;
using testing::drive;
using testing::keys;
using testing::moved;
using testing::placed;
using testing::scaled;
using testing::turned;

Pose pose_at(const Scene& scene, double time_s) {
    return pose(scene, choose_clip(scene, "all"), time_s);
}

/// Where the node's own point (x, y, z) is in the world.
glm::dvec3 in_world(const Pose& at, Index node, const glm::dvec3& point) {
    return glm::dvec3{at.world[node] * glm::dvec4{point, 1.0}};
}

TEST_CASE("a node scales, then turns, then moves", "[anim]") {
    Scene scene = testing::empty_scene();
    Trs trs = turned(90.0, {0, 0, 1});
    trs.scale = {2, 3, 4};
    trs.translation = {10, 20, 30};
    add_node(scene, placed(trs));
    const Pose at = pose_at(scene, 0.0);

    // (1, 1, 1) -> (2, 3, 4) -> (-3, 2, 4) -> (7, 22, 34)
    CHECK(distance(in_world(at, 0, {1, 1, 1}), glm::dvec3{7, 22, 34}) < 1e-12);
}

TEST_CASE("children go with their parents", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index root = add_node(scene, placed(moved(1, 0, 0)));
    const Index arm = add_node(scene, placed(turned(90.0, {0, 0, 1})), root);
    const Index hand = add_node(scene, placed(moved(2, 0, 0)), arm);
    const Pose at = pose_at(scene, 0.0);

    CHECK(distance(in_world(at, hand, {0, 0, 0}), glm::dvec3{1, 2, 0}) < 1e-12);
    CHECK(distance(in_world(at, hand, {1, 0, 0}), glm::dvec3{1, 3, 0}) < 1e-12);
}

TEST_CASE("a parent may come after its children in the file", "[anim]") {
    Scene scene = testing::empty_scene();
    scene.nodes = {placed(moved(0, 1, 0)), placed(moved(1, 0, 0))};
    scene.nodes[0].parent = 1;
    scene.nodes[1].children = {0};
    scene.scenes[0] = {1};

    CHECK(distance(in_world(pose_at(scene, 0.0), 0, {0, 0, 0}), glm::dvec3{1, 1, 0}) < 1e-12);
}

TEST_CASE("a node's matrix stands in the place of its transform", "[anim]") {
    Scene scene = testing::empty_scene();
    Node node = placed(moved(100, 100, 100));
    // A shear, which no translation, rotation and scale can make: x grows with y.
    node.matrix = glm::dmat4{{1, 0, 0, 0}, {0.5, 1, 0, 0}, {0, 0, 1, 0}, {7, 8, 9, 1}};
    const Index root = add_node(scene, placed(scaled(2, 2, 2)));
    const Index sheared = add_node(scene, node, root);
    const Index child = add_node(scene, placed(moved(0, 4, 0)), sheared);

    CHECK(distance(in_world(pose_at(scene, 0.0), child, {0, 0, 0}), glm::dvec3{18, 24, 18}) < 1e-12);
}

TEST_CASE("rotations in the file need not be unit length", "[anim]") {
    Scene scene = testing::empty_scene();
    Trs trs;
    trs.rotation = glm::dquat{3.0, 0.0, 0.0, 3.0};  // 90 degrees about z, much too long
    add_node(scene, placed(trs));
    trs.rotation = glm::dquat{0.0, 0.0, 0.0, 0.0};
    add_node(scene, placed(trs));
    const Pose at = pose_at(scene, 0.0);

    CHECK(distance(in_world(at, 0, {1, 0, 0}), glm::dvec3{0, 1, 0}) < 1e-12);
    CHECK(at.world[1] == glm::dmat4{1.0});
}

TEST_CASE("channels replace what the node says and leave the rest alone", "[anim]") {
    Scene scene = testing::empty_scene();
    Trs trs = turned(90.0, {0, 0, 1});
    trs.scale = {2, 2, 2};
    trs.translation = {5, 5, 5};
    add_node(scene, placed(trs));
    drive(scene, add_animation(scene), 0, ChannelPath::translation,
          keys(Interpolation::linear, 3, {0, 1}, {0, 0, 0, 10, 0, 0}));

    CHECK(distance(in_world(pose_at(scene, 0.25), 0, {1, 0, 0}), glm::dvec3{2.5, 2, 0}) < 1e-12);
}

TEST_CASE("rotation and scale channels reach their nodes", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index root = add_node(scene, {});
    const Index child = add_node(scene, placed(moved(1, 0, 0)), root);
    const Index animation = add_animation(scene);
    drive(scene, animation, root, ChannelPath::rotation,
          keys(Interpolation::linear, 4, {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0}));
    drive(scene, animation, root, ChannelPath::scale,
          keys(Interpolation::linear, 3, {0, 1}, {1, 1, 1, 3, 3, 3}));

    CHECK(distance(in_world(pose_at(scene, 0.5), child, {0, 0, 0}), glm::dvec3{0, 2, 0}) < 1e-12);
}

TEST_CASE("of two animations that meet the later one wins", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, {});
    for (const float x : {1.0f, 2.0f}) {
        drive(scene, add_animation(scene), 0, ChannelPath::translation,
              keys(Interpolation::step, 3, {0}, {x, 0, 0}));
    }

    CHECK(in_world(pose_at(scene, 0.0), 0, {0, 0, 0}).x == 2.0);
    CHECK(in_world(pose(scene, choose_clip(scene, "0"), 0.0), 0, {0, 0, 0}).x == 1.0);
}

TEST_CASE("animations that are not in the clip do not play", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, {});
    drive(scene, add_animation(scene), 0, ChannelPath::translation,
          keys(Interpolation::step, 3, {0}, {1, 0, 0}));

    CHECK(pose(scene, choose_clip(scene, "none"), 0.0).world[0] == glm::dmat4{1.0});
}

TEST_CASE("nodes outside the scene that is shown are posed too", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index hidden = testing::add_hidden_root(scene, placed(moved(1, 0, 0)));
    scene.nodes.push_back(placed(moved(0, 1, 0)));
    scene.nodes[1].parent = hidden;
    scene.nodes[hidden].children = {1};

    CHECK(distance(in_world(pose_at(scene, 0.0), 1, {0, 0, 0}), glm::dvec3{1, 1, 0}) < 1e-12);
}

TEST_CASE("morph weights come from the animation, else the node, else the mesh", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = testing::triangle();
    primitive.targets.resize(2);
    const Index mesh = testing::add_mesh(scene, primitive, {0.25f, 0.5f});
    const Index of_mesh = add_node(scene, placed({}, mesh));
    const Index of_node = add_node(scene, placed({}, mesh));
    scene.nodes[of_node].weights = {0.125f, 1.0f};
    const Index animated = add_node(scene, placed({}, mesh));
    scene.nodes[animated].weights = {0.125f, 1.0f};
    drive(scene, add_animation(scene), animated, ChannelPath::weights,
          keys(Interpolation::linear, 2, {0, 1}, {0, 0, 1, 0.5f}));
    const Index bare = add_node(scene, {});
    const Pose at = pose_at(scene, 0.5);

    CHECK(at.weights[of_mesh] == std::vector{0.25f, 0.5f});
    CHECK(at.weights[of_node] == std::vector{0.125f, 1.0f});
    CHECK(at.weights[animated] == std::vector{0.5f, 0.25f});
    CHECK(at.weights[bare].empty());
}

TEST_CASE("cameras, lights and materials are the scene's", "[anim]") {
    Scene scene = testing::empty_scene();
    scene.cameras.resize(1);
    scene.cameras[0].fov_y_rad = 0.5;
    scene.lights.resize(2);
    scene.lights[1].intensity = 7.0f;
    scene.materials.resize(3);
    scene.materials[2].roughness = 0.25f;
    const Pose at = pose_at(scene, 1.5);

    CHECK(at.time_s == 1.5);
    REQUIRE(at.cameras.size() == 1);
    CHECK(at.cameras[0].fov_y_rad == 0.5);
    REQUIRE(at.lights.size() == 2);
    CHECK(at.lights[1].intensity == 7.0f);
    REQUIRE(at.materials.size() == 3);
    CHECK(at.materials[2].roughness == 0.25f);
}

}  // namespace
}  // namespace gridreel::anim
