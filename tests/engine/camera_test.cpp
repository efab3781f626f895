#include "engine/camera.h"

#include "anim/error.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace gridreel;

namespace {

const anim::Camera right_angled{.name = {},
                                .kind = anim::Camera::Kind::perspective,
                                .fov_y_rad = std::numbers::pi / 2,
                                .aspect = {},
                                .near_m = 0.5,
                                .far_m = 20.0};

void check_near(const glm::dvec3& a, const glm::dvec3& b) {
    CHECK(a.x == Approx(b.x).margin(1e-6));
    CHECK(a.y == Approx(b.y).margin(1e-6));
    CHECK(a.z == Approx(b.z).margin(1e-6));
}

}  // namespace

TEST_CASE("a perspective camera keeps its vertical field of view and widens with the picture", "[engine]") {
    // Half the height is tan(45 degrees) = 1 at depth 1; 200 x 100 pixels make half the width 2.
    const engine::View view = engine::view_of(right_angled, glm::dmat4(1.0), 200, 100);
    check_near(view.ray_direction({0.0, 0.0}), {-2.0, 1.0, -1.0});
    check_near(view.ray_direction({200.0, 100.0}), {2.0, -1.0, -1.0});
    check_near(view.ray_direction({100.0, 50.0}), {0.0, 0.0, -1.0});
    check_near(view.ray_origin({0.0, 0.0}), {0.0, 0.0, 0.0});
    CHECK(view.near_m == 0.5);
    CHECK(view.far_m == 20.0);
}

TEST_CASE("an orthographic camera sends parallel rays from a plane of its own height", "[engine]") {
    const anim::Camera camera{
        .name = {}, .kind = anim::Camera::Kind::orthographic, .aspect = {}, .x_mag = 9.0, .y_mag = 3.0};
    const engine::View view =
        engine::view_of(camera, glm::translate(glm::dmat4(1.0), {10.0, 20.0, 30.0}), 200, 100);
    check_near(view.ray_origin({0.0, 0.0}), {10.0 - 6.0, 20.0 + 3.0, 30.0});
    check_near(view.ray_origin({200.0, 100.0}), {10.0 + 6.0, 20.0 - 3.0, 30.0});
    check_near(view.ray_direction({0.0, 0.0}), {0.0, 0.0, -1.0});
    CHECK(view.pixel_width(1.0) == Approx(6.0 / 100.0));
    CHECK(view.pixel_width(50.0) == Approx(6.0 / 100.0));
}

TEST_CASE("a camera follows its node's place and rotation, but not its scale", "[engine]") {
    // Turned a quarter about y, -z becomes -x.
    glm::dmat4 world = glm::translate(glm::dmat4(1.0), {1.0, 2.0, 3.0});
    world = glm::rotate(world, std::numbers::pi / 2, {0.0, 1.0, 0.0});
    world = glm::scale(world, {2.0, 5.0, 0.1});
    const engine::View view = engine::view_of(right_angled, world, 100, 100);
    check_near(view.eye, {1.0, 2.0, 3.0});
    check_near(view.forward, {-1.0, 0.0, 0.0});
    check_near(view.up, {0.0, 1.0, 0.0});
    check_near(view.right, {0.0, 0.0, -1.0});
    CHECK(view.depth({-3.0, 7.0, 8.0}) == Approx(4.0));
}

TEST_CASE("a ray's t is its depth along the view axis", "[engine]") {
    const engine::View view = engine::view_of(right_angled, glm::dmat4(1.0), 64, 64);
    const glm::dvec3 point = 7.5 * glm::dvec3(view.ray_direction({3.25, 60.5}));
    CHECK(view.depth(point) == Approx(7.5));
}

TEST_CASE("the width of a pixel grows with depth", "[engine]") {
    const engine::View view = engine::view_of(right_angled, glm::dmat4(1.0), 100, 100);
    CHECK(view.pixel_width(1.0) == Approx(0.02));
    CHECK(view.pixel_width(10.0) == Approx(0.2));
}

TEST_CASE("a camera node scaled to nothing is an error", "[engine]") {
    const glm::dmat4 flat = glm::scale(glm::dmat4(1.0), {1.0, 1.0, 0.0});
    CHECK_THROWS_WITH(
        engine::view_of(right_angled, flat, 100, 100, "x: /nodes/3 \"Cam\""),
        Catch::Matchers::StartsWith("x: /nodes/3 \"Cam\": the camera's node has no orientation"));
}
