#include "engine/hit_point.h"

#include <glm/geometric.hpp>

#include <catch2/catch.hpp>

using namespace gridreel;
using engine::Ray;
using engine::Side;

namespace {

/// One triangle in the plane z = 0, counter-clockwise seen from +z.
anim::FrameGeometry one_triangle(bool mirrored = false) {
    anim::FrameGeometry geometry;
    geometry.positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    geometry.texcoords[0] = {{0, 0}, {1, 0}, {0, 1}};
    geometry.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 0}};
    geometry.triangles = {{0, 1, 2}};
    geometry.triangle_part = {0};
    geometry.parts.resize(1);
    geometry.mirrored = {mirrored};
    return geometry;
}

}  // namespace

TEST_CASE("a hit point interpolates what its corners carry", "[engine]") {
    const anim::FrameGeometry geometry = one_triangle();
    const auto point = engine::hit_point(geometry, 0, Ray{{1, 2, 5}, {0, 0, -3}});
    CHECK(point.position == glm::dvec3(1, 2, 0));
    CHECK(point.weights == glm::dvec3(0.25, 0.25, 0.5));
    CHECK(engine::texcoord_at(geometry, 0, point, 0) == glm::vec2(0.25f, 0.5f));
    CHECK(engine::texcoord_at(geometry, 0, point, 1) == glm::vec2(0.0f));
    CHECK(engine::color_at(geometry, 0, point) == glm::vec4(0.25f, 0.25f, 0.5f, 0.5f));
    CHECK(point.area_normal == glm::dvec3(0, 0, 16));
}

TEST_CASE("the winding tells front from back, the other way round under a mirrored node", "[engine]") {
    const Ray from_front{{1, 1, 5}, {0, 0, -1}};
    const Ray from_back{{1, 1, -5}, {0, 0, 1}};
    CHECK(engine::hit_point(one_triangle(), 0, from_front).side == Side::front);
    CHECK(engine::hit_point(one_triangle(), 0, from_back).side == Side::back);
    CHECK(engine::hit_point(one_triangle(true), 0, from_front).side == Side::back);
    CHECK(engine::hit_point(one_triangle(true), 0, from_back).side == Side::front);
    CHECK(engine::hit_point(one_triangle(true), 0, from_back).area_normal.z == -16.0);
}

TEST_CASE("a ray that misses by a rounding is taken to the triangle's edge", "[engine]") {
    const auto point = engine::hit_point(one_triangle(), 0, Ray{{-1e-6f, 2.0f, 5.0f}, {0, 0, -1}});
    CHECK(point.weights.y == 0.0);
    CHECK(point.position.x == 0.0);
    CHECK(point.position.y == Approx(2.0));
}

TEST_CASE("a triangle seen edge-on still gives a point of it", "[engine]") {
    const auto point = engine::hit_point(one_triangle(), 0, Ray{{-5, 1, 0}, {1, 0, 0}});
    CHECK(point.weights.x + point.weights.y + point.weights.z == Approx(1.0));
    CHECK(point.position.z == 0.0);
}

TEST_CASE("far from the origin a hit point lies in its triangle's plane to double precision", "[engine]") {
    anim::FrameGeometry geometry = one_triangle();
    geometry.positions = {{1e6f, 2e6f, 3e6f}, {1e6f + 1, 2e6f, 3e6f}, {1e6f, 2e6f + 1, 3e6f}};
    const auto point = engine::hit_point(geometry, 0, Ray{{0, 0, 0}, {1.0000002f, 2.0000003f, 3.0f}});
    CHECK(point.position.z == Approx(3e6).epsilon(1e-15));
}
