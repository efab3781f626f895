// What moves, what is left alone, and that neither threads nor history show.

#include "anim/frame_geometry.h"

#include "random_scene.h"
#include "scene_builder.h"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace gridreel::anim {
namespace {

using testing::add_animation;
using testing::add_mesh;
using testing::add_node;
using testing::drive;
using testing::keys;
using testing::placed;
using testing::triangle;

Sampler moving_x() {
    return keys(Interpolation::linear, 3, {0, 1}, {0, 0, 0, 8, 0, 0});
}

bool same_vertices(const FrameGeometry& a, const FrameGeometry& b) {
    return a.positions == b.positions && a.normals == b.normals && a.tangents == b.tangents &&
           a.mirrored == b.mirrored;
}

TEST_CASE("parts move with their nodes, their nodes' ancestors, joints and weights", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = triangle();
    primitive.targets.resize(1);
    const Index mesh = add_mesh(scene, primitive);
    Primitive bound = triangle();
    testing::bind(bound, {0, 0, 0, 0}, {1, 0, 0, 0});
    const Index skinned_mesh = add_mesh(scene, bound);

    const Index driven = add_node(scene, placed({}, mesh));
    const Index child = add_node(scene, placed({}, mesh), driven);
    const Index grandchild = add_node(scene, placed({}, mesh), child);
    const Index morphing = add_node(scene, placed({}, mesh));  // its child stays
    add_node(scene, placed({}, mesh), morphing);
    const Index still = add_node(scene, placed({}, mesh));

    // A still node with a joint that moves with its parent, and a moving one with a still joint.
    Node walker = placed({}, skinned_mesh);
    walker.skin = testing::add_skin(scene, {still, grandchild});
    const Index walking = add_node(scene, walker);
    walker.skin = testing::add_skin(scene, {still});
    add_node(scene, walker, driven);

    const Index animation = add_animation(scene);
    drive(scene, animation, driven, ChannelPath::translation, moving_x());
    drive(scene, animation, morphing, ChannelPath::weights, keys(Interpolation::step, 1, {0, 1}, {0, 1}));
    // Keyed, but going nowhere.
    drive(scene, animation, still, ChannelPath::translation,
          keys(Interpolation::linear, 3, {0, 1}, {1, 2, 3, 1, 2, 3}));

    const FrameGeometry frame = lay_out(scene, choose_clip(scene));
    std::vector<Index> moving;
    for (const Part& part : frame.parts) {
        if (part.moves) moving.push_back(part.node);
    }
    CHECK(moving == std::vector<Index>{driven, child, grandchild, morphing, walking});
    CHECK(frame.moving_triangles() == 5);

    const FrameGeometry at_rest = lay_out(scene, choose_clip(scene, "none"));
    CHECK(at_rest.moving_triangles() == 0);
}

TEST_CASE("later frames write moving parts and leave still ones alone", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index mesh = add_mesh(scene, triangle());
    add_node(scene, placed({}, mesh));
    const Index moving = add_node(scene, placed({}, mesh));
    drive(scene, add_animation(scene), moving, ChannelPath::translation, moving_x());
    const Clip clip = choose_clip(scene);
    FrameGeometry frame = lay_out(scene, clip);
    CHECK_FALSE(frame.posed);
    deform(scene, pose(scene, clip, 0.25), frame);
    CHECK(frame.posed);
    CHECK(frame.positions[1] == glm::vec3{1, 0, 0});
    CHECK(frame.positions[4] == glm::vec3{3, 0, 0});

    const glm::vec3 poison{-123, 456, 789};
    frame.positions.assign(6, poison);
    frame.normals.assign(6, poison);
    deform(scene, pose(scene, clip, 0.5), frame);

    CHECK(frame.positions == std::vector<glm::vec3>{poison, poison, poison, {4, 0, 0}, {5, 0, 0}, {4, 1, 0}});
    CHECK(frame.normals[2] == poison);
    CHECK(frame.normals[3] == glm::vec3{0, 0, 1});
}

TEST_CASE("a node that turns inside out is mirrored while it does", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, placed({}, add_mesh(scene, triangle())));
    drive(scene, add_animation(scene), 0, ChannelPath::scale,
          keys(Interpolation::linear, 3, {0, 1}, {1, 1, 1, -1, 1, 1}));
    const Clip clip = choose_clip(scene);
    FrameGeometry frame = lay_out(scene, clip);

    deform(scene, pose(scene, clip, 0.25), frame);
    CHECK_FALSE(frame.mirrored[0]);
    deform(scene, pose(scene, clip, 0.75), frame);
    CHECK(frame.mirrored[0]);
    deform(scene, pose(scene, clip, 0.25), frame);
    CHECK_FALSE(frame.mirrored[0]);
}

TEST_CASE("a frame does not depend on the frames before it", "[anim]") {
    const std::uint32_t seed = GENERATE(range(1u, 6u));
    const Scene scene = testing::random_scene(seed);
    const Clip clip = choose_clip(scene, "all");

    FrameGeometry there_and_back = lay_out(scene, clip);
    for (const double time_s : {0.3, 1.7, 0.9}) deform(scene, pose(scene, clip, time_s), there_and_back);
    FrameGeometry direct = lay_out(scene, clip);
    deform(scene, pose(scene, clip, 0.9), direct);

    CHECK(same_vertices(there_and_back, direct));
}

TEST_CASE("a frame has the same bits on one thread and on several", "[anim]") {
    const tbb::global_control more_than_cores{tbb::global_control::max_allowed_parallelism, 5};
    const Scene scene = testing::random_scene(7, {.vertices_per_part = 20'000});
    const Clip clip = choose_clip(scene, "all");
    const auto frame_with = [&](int threads) {
        FrameGeometry frame = lay_out(scene, clip);
        tbb::task_arena arena{threads};
        arena.execute([&] {
            deform(scene, pose(scene, clip, 0.4), frame);
            deform(scene, pose(scene, clip, 1.3), frame);
        });
        return frame;
    };
    const FrameGeometry alone = frame_with(1);

    CHECK(same_vertices(frame_with(2), alone));
    CHECK(same_vertices(frame_with(5), alone));
}

}  // namespace
}  // namespace gridreel::anim
