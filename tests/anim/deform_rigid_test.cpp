// The layout of a frame, and parts that go with their nodes.

#include "anim/frame_geometry.h"

#include "scene_builder.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace gridreel::anim {
namespace {

using testing::add_mesh;
using testing::add_node;
using testing::distance;
using testing::frame_at;
using testing::moved;
using testing::placed;
using testing::scaled;
using testing::triangle;
using testing::turned;

constexpr float root_half = 0.70710678f;

/// A triangle with these normals at its three corners, on a node with this transform.
FrameGeometry triangle_under(const Trs& trs, const std::vector<glm::vec3>& normals) {
    Scene scene = testing::empty_scene();
    Primitive primitive = triangle();
    primitive.normals = normals;
    add_node(scene, placed(trs, add_mesh(scene, primitive)));
    return frame_at(scene, 0.0);
}

bool all_unit(const std::vector<glm::vec3>& normals) {
    for (const glm::vec3& normal : normals) {
        if (!(std::abs(glm::length(normal) - 1.0f) < 1e-6f)) return false;
    }
    return true;
}

TEST_CASE("parts follow the nodes depth first, primitives and vertices in file order", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index pair = add_mesh(scene, triangle());
    scene.meshes[pair].primitives.push_back(testing::points({{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {9, 9, 9}}));
    scene.meshes[pair].primitives[1].triangles = {{2, 1, 0}, {0, 1, 2}};
    scene.meshes[pair].primitives[1].material = 4;
    const Index single = add_mesh(scene, triangle());
    const Index first = add_node(scene, placed(moved(1, 0, 0), pair));
    const Index last = add_node(scene, placed(moved(3, 0, 0), single));
    const Index child = add_node(scene, placed(moved(0, 2, 0), single), first);
    testing::add_hidden_root(scene, placed({}, single));
    const FrameGeometry frame = frame_at(scene, 0.0);

    REQUIRE(frame.parts.size() == 4);
    CHECK(frame.parts[0].node == first);
    CHECK(frame.parts[1].node == first);
    CHECK(frame.parts[1].primitive == 1);
    CHECK(frame.parts[1].material == Index{4});
    CHECK(frame.parts[1].first_vertex == 3);
    CHECK(frame.parts[1].vertex_count == 4);
    CHECK(frame.parts[1].first_triangle == 1);
    CHECK(frame.parts[1].triangle_count == 2);
    CHECK(frame.parts[2].node == child);
    CHECK(frame.parts[2].mesh == single);
    CHECK(frame.parts[3].node == last);

    CHECK(frame.triangles ==
          std::vector<glm::uvec3>{{0, 1, 2}, {5, 4, 3}, {3, 4, 5}, {7, 8, 9}, {10, 11, 12}});
    CHECK(frame.triangle_part == std::vector<std::uint32_t>{0, 1, 1, 2, 3});
    CHECK(frame.positions == std::vector<glm::vec3>{{1, 0, 0},
                                                    {2, 0, 0},
                                                    {1, 1, 0},  //
                                                    {6, 5, 5},
                                                    {7, 5, 5},
                                                    {6, 6, 5},
                                                    {10, 9, 9},  //
                                                    {1, 2, 0},
                                                    {2, 2, 0},
                                                    {1, 3, 0},  //
                                                    {3, 0, 0},
                                                    {4, 0, 0},
                                                    {3, 1, 0}});
    CHECK(frame.moving_triangles() == 0);
}

TEST_CASE("attributes that only some parts have are filled up for the others", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, placed({}, add_mesh(scene, triangle())));
    Primitive rich = triangle();
    rich.texcoords[1] = {{0.25f, 0.5f}, {1, 0}, {0, 1}};
    rich.colors.assign(3, {0.5f, 0.25f, 0.125f, 1.0f});
    add_node(scene, placed({}, add_mesh(scene, rich)));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(frame.texcoords[0].empty());
    CHECK(frame.texcoords[1] ==
          std::vector<glm::vec2>{{0, 0}, {0, 0}, {0, 0}, {0.25f, 0.5f}, {1, 0}, {0, 1}});
    REQUIRE(frame.colors.size() == 6);
    CHECK(frame.colors[2] == glm::vec4{1.0f});
    CHECK(frame.colors[3] == glm::vec4{0.5f, 0.25f, 0.125f, 1.0f});
    CHECK(frame.tangents.empty());
    CHECK_FALSE(frame.parts[0].has_colors);
    CHECK(frame.parts[1].has_colors);
    CHECK_FALSE(frame.parts[1].has_texcoords[0]);
    CHECK(frame.parts[1].has_texcoords[1]);
}

TEST_CASE("a part without normals is not smooth, and its tangents are ignored", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive flat = triangle();
    flat.normals.clear();
    flat.tangents.assign(3, {1, 0, 0, 1});
    add_node(scene, placed(scaled(3, 3, 3), add_mesh(scene, flat)));
    add_node(scene, placed({}, add_mesh(scene, triangle())));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK_FALSE(frame.parts[0].smooth);
    CHECK_FALSE(frame.parts[0].has_tangents);
    CHECK(frame.tangents.empty());
    CHECK(frame.normals[0] == glm::vec3{0.0f});
    CHECK(frame.parts[1].smooth);
    CHECK(frame.normals[3] == glm::vec3{0, 0, 1});
}

TEST_CASE("normals turn with their node", "[anim]") {
    const FrameGeometry frame = triangle_under(turned(90.0, {0, 0, 1}), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});

    CHECK(distance(frame.normals[0], glm::vec3{0, 1, 0}) < 1e-6);
    CHECK(distance(frame.normals[1], glm::vec3{-1, 0, 0}) < 1e-6);
    CHECK(distance(frame.normals[2], glm::vec3{0, 0, 1}) < 1e-6);
}

TEST_CASE("normals stay upright on surfaces that are stretched", "[anim]") {
    // Stretching x by 2 makes the slope x + y = c flatter: its normal (1, 1) becomes (1/2, 1).
    const glm::vec3 expected{0.44721360f, 0.89442719f, 0.0f};
    const double size = GENERATE(1e-12, 1.0, 1e12);
    const FrameGeometry frame =
        triangle_under(scaled(2 * size, size, size),
                       {{root_half, root_half, 0}, {0.5f * root_half, 0.5f * root_half, 0}, {0, 0, 1}});

    CHECK(distance(frame.normals[0], expected) < 1e-6);
    CHECK(distance(frame.normals[1], expected) < 1e-6);  // not unit length in the file
    CHECK(distance(frame.normals[2], glm::vec3{0, 0, 1}) < 1e-6);
}

TEST_CASE("a mirrored node keeps its winding and its normals outside", "[anim]") {
    Scene scene = testing::empty_scene();
    Primitive primitive = triangle();
    primitive.normals = {{1, 0, 0}, {0, 0, 1}, {root_half, root_half, 0}};
    primitive.tangents = {{0, 1, 0, 1}, {1, 0, 0, -1}, {0, 0, 1, 1}};
    add_node(scene, placed(scaled(-1, 1, 1), add_mesh(scene, primitive)));
    add_node(scene, placed(scaled(-1, -1, 1), 0));
    add_node(scene, placed(scaled(-1, -1, -1), 0));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(frame.mirrored == std::vector<bool>{true, false, true});
    CHECK(frame.triangles[0] == glm::uvec3{0, 1, 2});
    CHECK(distance(frame.positions[1], glm::vec3{-1, 0, 0}) < 1e-6);
    CHECK(distance(frame.normals[0], glm::vec3{-1, 0, 0}) < 1e-6);
    CHECK(distance(frame.normals[1], glm::vec3{0, 0, 1}) < 1e-6);
    CHECK(distance(frame.normals[2], glm::vec3{-root_half, root_half, 0}) < 1e-6);

    // Tangents go with the matrix, and w turns round so that cross(normal, tangent) * w, the bitangent,
    // does so too: the bitangent of the second corner, (0, -1, 0), is not touched by this mirror.
    CHECK(distance(frame.tangents[0], glm::vec4{0, 1, 0, -1}) < 1e-6);
    CHECK(distance(frame.tangents[1], glm::vec4{-1, 0, 0, 1}) < 1e-6);
    const glm::vec3 bitangent =
        glm::cross(frame.normals[1], glm::vec3{frame.tangents[1]}) * frame.tangents[1].w;
    CHECK(distance(bitangent, glm::vec3{0, -1, 0}) < 1e-6);

    // Two mirrors are a rotation, three a mirror.
    CHECK(distance(frame.normals[3], glm::vec3{-1, 0, 0}) < 1e-6);
    CHECK(distance(frame.tangents[4], glm::vec4{-1, 0, 0, -1}) < 1e-6);
    CHECK(distance(frame.normals[7], glm::vec3{0, 0, -1}) < 1e-6);
    CHECK(distance(frame.tangents[7], glm::vec4{-1, 0, 0, 1}) < 1e-6);
}

TEST_CASE("a part flattened onto a plane has that plane's normal", "[anim]") {
    const FrameGeometry frame =
        triangle_under(scaled(1, 1, 0), {{0, 0, 1}, {1, 0, 0}, {0, root_half, root_half}});

    CHECK(distance(frame.normals[0], glm::vec3{0, 0, 1}) < 1e-6);
    CHECK(distance(glm::abs(frame.normals[1]), glm::vec3{0, 0, 1}) < 1e-6);
    CHECK(distance(frame.normals[2], glm::vec3{0, 0, 1}) < 1e-6);
    CHECK_FALSE(frame.mirrored[0]);
}

TEST_CASE("parts flattened onto a line or a point have finite unit normals", "[anim]") {
    const Trs trs = GENERATE(scaled(0, 0, 0), scaled(1, 0, 0), scaled(0, -2, 0), scaled(1e-40, 1e-40, 1e-40));
    const FrameGeometry frame = triangle_under(trs, {{0, 0, 1}, {1, 0, 0}, {0, root_half, root_half}});

    CHECK(all_unit(frame.normals));
}

TEST_CASE("normals of length zero in the file do not become NaN", "[anim]") {
    CHECK(all_unit(triangle_under(scaled(1, 2, 3), {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}).normals));
}

TEST_CASE("a model far from its file's origin keeps its digits", "[anim]") {
    // A million metres away floats are 6 cm apart; the node brings the model back to the origin.
    Scene scene = testing::empty_scene();
    Primitive primitive = testing::points({{1e6f, 0, 0}, {1e6f + 0.5f, 1, 0}, {1e6f + 1, 0, 1}});
    primitive.triangles = {{0, 1, 2}};
    Trs trs = turned(30.0, {1, 2, 3});
    trs.translation = -(trs.rotation * glm::dvec3{1e6, 0, 0});
    add_node(scene, placed(trs, add_mesh(scene, primitive)));
    const FrameGeometry frame = frame_at(scene, 0.0);

    for (std::size_t v = 0; v < 3; ++v) {
        const glm::dvec3 exact = trs.rotation * (glm::dvec3{primitive.positions[v]} - glm::dvec3{1e6, 0, 0});
        CHECK(distance(glm::dvec3{frame.positions[v]}, exact) < 1e-6);
    }
}

TEST_CASE("a model far from the world's origin is placed as well as floats can say", "[anim]") {
    Scene scene = testing::empty_scene();
    Trs trs = turned(30.0, {1, 2, 3});
    trs.translation = {100'000.1, -50'000.2, 75'000.3};
    add_node(scene, placed(trs, add_mesh(scene, triangle())));
    const FrameGeometry frame = frame_at(scene, 0.0);

    for (std::size_t v = 0; v < 3; ++v) {
        const glm::dvec3 exact = trs.rotation * glm::dvec3{triangle().positions[v]} + trs.translation;
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(frame.positions[v][axis] == static_cast<float>(exact[axis]));
        }
    }
}

TEST_CASE("a scene without meshes has an empty frame", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, {});
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(frame.parts.empty());
    CHECK(frame.positions.empty());
    CHECK(frame.posed);
}

}  // namespace
}  // namespace gridreel::anim
