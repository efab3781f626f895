#include "engine/twin_triangles.h"

#include "anim/pose.h"
#include "scenes.h"
#include "traversal/ray_batch.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using test::SceneBuilder;
using traversal::no_triangle;

namespace {

/// A quad (triangles 0 and 1) whose mesh has its other side as well: a, c, b and so on, corners rotated
/// (triangles 2 and 3).
SceneBuilder two_sides() {
    SceneBuilder builder;
    anim::Primitive side = test::quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    side.material = builder.add_material(test::matte(glm::vec3(1.0f)));
    builder.add_mesh(side);
    side.triangles = {{2, 1, 0}, {0, 3, 2}};
    builder.scene.meshes[0].primitives.push_back(side);
    return builder;
}

anim::FrameGeometry posed(const anim::Scene& scene) {
    anim::FrameGeometry geometry = anim::lay_out(scene, {});
    anim::deform(scene, anim::pose(scene, {}, 0.0), geometry);
    return geometry;
}

}  // namespace

TEST_CASE("triangles with the same corners and opposite windings are twins", "[engine]") {
    const SceneBuilder builder = two_sides();
    const anim::FrameGeometry geometry = posed(builder.scene);
    const engine::TwinTriangles twins(builder.scene, geometry);
    CHECK(twins.twin_of(geometry, 0) == 2);
    CHECK(twins.twin_of(geometry, 1) == 3);
    CHECK(twins.twin_of(geometry, 2) == 0);
    CHECK(twins.twin_of(geometry, 3) == 1);
}

TEST_CASE("copies with the same winding are no twins", "[engine]") {
    SceneBuilder builder = two_sides();
    auto& primitives = builder.scene.meshes[0].primitives;
    primitives[1] = primitives[0];
    const anim::FrameGeometry geometry = posed(builder.scene);
    const engine::TwinTriangles twins(builder.scene, geometry);
    for (std::uint32_t triangle = 0; triangle < 4; ++triangle)
        CHECK(twins.twin_of(geometry, triangle) == no_triangle);
}

TEST_CASE("double-sided triangles need no twins", "[engine]") {
    SceneBuilder builder = two_sides();
    builder.scene.materials[0].double_sided = true;
    const anim::FrameGeometry geometry = posed(builder.scene);
    CHECK(engine::TwinTriangles(builder.scene, geometry).twin_of(geometry, 0) == no_triangle);
}

TEST_CASE("twins that a pose moves apart are twins no more", "[engine]") {
    const SceneBuilder builder = two_sides();
    anim::FrameGeometry geometry = posed(builder.scene);
    const engine::TwinTriangles twins(builder.scene, geometry);
    geometry.positions[2].z += 0.001f;  // a corner of triangles 0 and 1 alone
    CHECK(twins.twin_of(geometry, 0) == no_triangle);
    CHECK(twins.twin_of(geometry, 2) == no_triangle);
}

TEST_CASE("each instance of a two-sided mesh has its own twins", "[engine]") {
    SceneBuilder builder = two_sides();
    anim::Node instance = builder.scene.nodes[0];
    builder.add_node(instance);
    const anim::FrameGeometry geometry = posed(builder.scene);
    const engine::TwinTriangles twins(builder.scene, geometry);
    CHECK(twins.twin_of(geometry, 0) == 2);
    CHECK(twins.twin_of(geometry, 4) == 6);
    CHECK(twins.twin_of(geometry, 6) == 4);
}
