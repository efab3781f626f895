// Skins: vertices that go with joints.

#include "anim/frame_geometry.h"

#include "scene_builder.h"

#include <catch2/catch.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace gridreel::anim {
namespace {

using testing::add_mesh;
using testing::add_node;
using testing::add_skin;
using testing::distance;
using testing::frame_at;
using testing::moved;
using testing::placed;
using testing::scaled;
using testing::triangle;
using testing::turned;

/// A node that bears `primitive` with a skin of these joints.
Index add_skinned(Scene& scene, Primitive primitive, Index skin, const Trs& trs = {}) {
    Node node = placed(trs, add_mesh(scene, std::move(primitive)));
    node.skin = skin;
    return add_node(scene, node);
}

/// One point, bound as given.
Primitive bound_point(const glm::vec3& position, std::vector<std::uint16_t> joints,
                      std::vector<float> weights) {
    Primitive primitive = testing::points({position});
    testing::bind(primitive, std::move(joints), std::move(weights));
    return primitive;
}

TEST_CASE("a vertex between two joints goes half the way with each", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index still = add_node(scene, {});
    const Index away = add_node(scene, placed(moved(2, 0, -4)));
    const Index skin = add_skin(scene, {still, away});
    add_skinned(scene, bound_point({1, 1, 1}, {0, 1, 0, 0}, {0.5f, 0.5f, 0, 0}), skin);
    add_skinned(scene, bound_point({1, 1, 1}, {1, 0, 0, 0}, {0.75f, 0.25f, 0, 0}), skin);
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(distance(frame.positions[0], glm::vec3{2, 1, -1}) < 1e-6);
    CHECK(distance(frame.positions[1], glm::vec3{2.5f, 1, -2}) < 1e-6);
}

TEST_CASE("joint indices count in the skin's list and not in the file's nodes", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, placed(moved(100, 0, 0)));
    const Index b = add_node(scene, placed(moved(0, 2, 0)));
    const Index a = add_node(scene, placed(moved(0, 1, 0)));
    add_skinned(scene, bound_point({0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}), add_skin(scene, {a, b}));

    CHECK(distance(frame_at(scene, 0.0).positions[0], glm::vec3{0, 2, 0}) < 1e-6);
}

TEST_CASE("inverse bind matrices undo the pose that the mesh was modelled in", "[anim]") {
    // The joint stood at (1, 0, 0) when the mesh was bound and now stands, turned by 90 degrees about z,
    // at (3, 0, 0): a vertex one metre beyond it swings from +x to +y.
    Scene scene = testing::empty_scene();
    Trs trs = turned(90.0, {0, 0, 1});
    trs.translation = {3, 0, 0};
    const Index joint = add_node(scene, placed(trs));
    const glm::dmat4 inverse_bind = glm::translate(glm::dmat4{1.0}, glm::dvec3{-1, 0, 0});
    add_skinned(scene, bound_point({2, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}),
                add_skin(scene, {joint}, {inverse_bind}));

    CHECK(distance(frame_at(scene, 0.0).positions[0], glm::vec3{3, 1, 0}) < 1e-6);
}

TEST_CASE("a skinned part ignores its own node's place in the tree", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index joint = add_node(scene, placed(moved(1, 0, 0)));
    const Index skin = add_skin(scene, {joint});
    Primitive primitive = triangle();
    testing::bind(primitive, {0, 0, 0, 0}, {1, 0, 0, 0});
    const Index carrier = add_node(scene, placed(scaled(-5, 7, 9)));
    Node node = placed(moved(10, 20, 30), add_mesh(scene, primitive));
    node.skin = skin;
    add_node(scene, node, carrier);
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(distance(frame.positions[1], glm::vec3{2, 0, 0}) < 1e-6);
    CHECK(distance(frame.normals[1], glm::vec3{0, 0, 1}) < 1e-6);
    CHECK_FALSE(frame.mirrored[0]);
}

TEST_CASE("joints take their parents along, joints or not", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index root = add_node(scene, placed(turned(90.0, {0, 0, 1})));
    const Index upper = add_node(scene, placed(moved(1, 0, 0)), root);
    const Index lower = add_node(scene, placed(moved(1, 0, 0)), upper);
    const Index skin = add_skin(scene, {lower, upper});
    add_skinned(scene, bound_point({0, 0, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}), skin);
    add_skinned(scene, bound_point({0, 0, 0}, {1, 0, 0, 0}, {1, 0, 0, 0}), skin);
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(distance(frame.positions[0], glm::vec3{0, 2, 0}) < 1e-6);
    CHECK(distance(frame.positions[1], glm::vec3{0, 1, 0}) < 1e-6);
}

TEST_CASE("joints may stand outside the scene that is shown", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index joint = testing::add_hidden_root(scene, placed(moved(0, 0, 6)));
    add_skinned(scene, bound_point({1, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0}), add_skin(scene, {joint}));
    const FrameGeometry frame = frame_at(scene, 0.0);

    REQUIRE(frame.positions.size() == 1);
    CHECK(distance(frame.positions[0], glm::vec3{1, 0, 6}) < 1e-6);
}

TEST_CASE("eight influences are the sum of all eight", "[anim]") {
    // Eight joints at x = 0, 1, ... 7 with weight 1/8 each: 28/8.
    Scene scene = testing::empty_scene();
    std::vector<Index> joints;
    for (int x = 0; x < 8; ++x) joints.push_back(add_node(scene, placed(moved(x, 0, 0))));
    const Index skin = add_skin(scene, joints);
    add_skinned(scene, bound_point({0, 5, 0}, {0, 1, 2, 3, 4, 5, 6, 7}, std::vector<float>(8, 0.125f)), skin);
    // The same four influences, side by side and spread over two sets.
    add_skinned(scene, bound_point({0, 5, 0}, {1, 3, 5, 7}, {0.5f, 0.25f, 0.125f, 0.125f}), skin);
    add_skinned(scene,
                bound_point({0, 5, 0}, {1, 0, 3, 0, 0, 5, 0, 7}, {0.5f, 0, 0.25f, 0, 0, 0.125f, 0, 0.125f}),
                skin);
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(distance(frame.positions[0], glm::vec3{3.5f, 5, 0}) < 1e-6);
    CHECK(distance(frame.positions[1], glm::vec3{2.75f, 5, 0}) < 1e-6);
    CHECK(distance(frame.positions[2], frame.positions[1]) < 1e-6);
}

TEST_CASE("normals and tangents go with the blended joints", "[anim]") {
    // Half of a joint at rest and half of one that scales x by 3 is a scale of 2: as for a rigid part,
    // the normal (1, 1) becomes (1/2, 1).
    Scene scene = testing::empty_scene();
    const Index rest = add_node(scene, {});
    const Index wide = add_node(scene, placed(scaled(3, 1, 1)));
    Primitive primitive = testing::points({{1, 1, 1}});
    primitive.normals = {{0.70710678f, 0.70710678f, 0}};
    primitive.tangents = {{0.70710678f, -0.70710678f, 0, -1}};
    testing::bind(primitive, {0, 1, 0, 0}, {0.5f, 0.5f, 0, 0});
    add_skinned(scene, primitive, add_skin(scene, {rest, wide}));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(distance(frame.positions[0], glm::vec3{2, 1, 1}) < 1e-6);
    CHECK(distance(frame.normals[0], glm::vec3{0.44721360f, 0.89442719f, 0}) < 1e-6);
    CHECK(distance(frame.tangents[0], glm::vec4{0.89442719f, -0.44721360f, 0, -1}) < 1e-6);
}

TEST_CASE("a mirrored skeleton mirrors its skin", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index root = add_node(scene, placed(scaled(-1, 1, 1)));
    const Index joint = add_node(scene, placed(moved(1, 0, 0)), root);
    Primitive primitive = triangle();
    primitive.normals.assign(3, {1, 0, 0});
    primitive.tangents.assign(3, {0, 1, 0, 1});
    testing::bind(primitive, {0, 0, 0, 0}, {1, 0, 0, 0});
    add_skinned(scene, primitive, add_skin(scene, {joint}));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(frame.mirrored[0]);
    CHECK(distance(frame.positions[1], glm::vec3{-2, 0, 0}) < 1e-6);
    CHECK(distance(frame.normals[1], glm::vec3{-1, 0, 0}) < 1e-6);
    CHECK(distance(frame.tangents[1], glm::vec4{0, 1, 0, -1}) < 1e-6);
}

TEST_CASE("joints that cancel each other leave finite unit normals", "[anim]") {
    // Half of a joint at rest and half of one turned by 180 degrees about z flatten x and y to a line.
    Scene scene = testing::empty_scene();
    const Index rest = add_node(scene, {});
    const Index turn = add_node(scene, placed(turned(180.0, {0, 0, 1})));
    const Index nothing = add_node(scene, placed(scaled(0, 0, 0)));
    const Index skin = add_skin(scene, {rest, turn, nothing});
    Primitive primitive = triangle();
    primitive.normals = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    testing::bind(primitive, {0, 1, 0, 0}, {0.5f, 0.5f, 0, 0});
    add_skinned(scene, primitive, skin);
    Primitive gone = triangle();
    testing::bind(gone, {2, 0, 0, 0}, {1, 0, 0, 0});
    add_skinned(scene, gone, skin);
    const FrameGeometry frame = frame_at(scene, 0.0);

    for (const glm::vec3& normal : frame.normals) CHECK(glm::length(normal) == Approx(1.0f));
    CHECK(distance(frame.positions[1], glm::vec3{0, 0, 0}) < 1e-6);
}

TEST_CASE("a primitive without joint influences goes with its node", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index joint = add_node(scene, placed(moved(100, 0, 0)));
    add_skinned(scene, triangle(), add_skin(scene, {joint}), moved(0, 0, 2));

    CHECK(distance(frame_at(scene, 0.0).positions[1], glm::vec3{1, 0, 2}) < 1e-6);
}

TEST_CASE("every vertex of a long part has its own influences", "[anim]") {
    // Joint j stands at z = j; vertex v goes a share of the way from joint v mod 7 to the next.
    Scene scene = testing::empty_scene();
    std::vector<Index> joints;
    for (int z = 0; z < 8; ++z) joints.push_back(add_node(scene, placed(moved(0, 0, z))));
    Primitive primitive;
    primitive.influences.per_vertex = 4;
    const int count = 5000;
    const auto share = [](int v) { return static_cast<float>(v % 11) / 10.0f; };
    for (int v = 0; v < count; ++v) {
        primitive.positions.emplace_back(v, 1, 0);
        const auto joint = static_cast<std::uint16_t>(v % 7);
        for (const int j : {int{joint}, joint + 1, 0, 0}) {
            primitive.influences.joints.push_back(static_cast<std::uint16_t>(j));
        }
        for (const float weight : {1.0f - share(v), share(v), 0.0f, 0.0f}) {
            primitive.influences.weights.push_back(weight);
        }
    }
    add_skinned(scene, primitive, add_skin(scene, joints));
    const FrameGeometry frame = frame_at(scene, 0.0);

    double worst = 0.0;
    for (int v = 0; v < count; ++v) {
        const glm::vec3 expected{v, 1.0f, static_cast<float>(v % 7) + share(v)};
        worst = std::max(worst, distance(frame.positions[static_cast<std::size_t>(v)], expected));
    }
    CHECK(worst < 1e-3);  // 1e-7 of the part's 5000 m
}

TEST_CASE("a skinned model far from the world's origin keeps its digits", "[anim]") {
    // 100 km away floats are 8 mm apart: half of that is all that may be lost.
    Scene scene = testing::empty_scene();
    const Index root = add_node(scene, placed(moved(100'000.1, 0, -100'000.7)));
    const Index a = add_node(scene, placed(turned(20.0, {1, 2, 3})), root);
    const Index b = add_node(scene, placed(turned(-40.0, {3, 1, 2})), root);
    const glm::vec3 point{0.3f, 0.7f, 0.9f};
    add_skinned(scene, bound_point(point, {0, 1, 0, 0}, {0.3f, 0.7f, 0, 0}), add_skin(scene, {a, b}));
    const FrameGeometry frame = frame_at(scene, 0.0);

    const glm::dvec3 exact = scene.nodes[root].trs.translation +
                             0.3 * (scene.nodes[a].trs.rotation * glm::dvec3{point}) +
                             0.7 * (scene.nodes[b].trs.rotation * glm::dvec3{point});
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(frame.positions[0][axis] == static_cast<float>(exact[axis]));
    }
}

}  // namespace
}  // namespace gridreel::anim
