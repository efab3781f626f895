#include "engine/render_camera.h"

#include "engine/fitting_view.h"
#include "scenes.h"

#include <catch2/catch.hpp>

using namespace gridreel;

namespace {

/// A floor from -2 to 2, and at (0, 1, 5) a camera of 3:2.
test::SceneBuilder floor_and_camera() {
    test::SceneBuilder builder;
    builder.add_mesh(test::floor(0.0f, 2.0f));
    const anim::Index tripod = builder.add_camera({0, 1, 5}, {0, 1, 0}, 0.8);
    builder.scene.nodes[tripod].name = "tripod";
    builder.scene.cameras[0].aspect = 1.5;
    return builder;
}

}  // namespace

TEST_CASE("a camera node gives the place, and the height that is left open", "[engine]") {
    const auto builder = floor_and_camera();
    const anim::Pose pose = anim::pose(builder.scene, {}, 0.0);
    const engine::RenderCamera open(builder.scene, {}, "auto", 120, std::nullopt);
    CHECK(open.height() == 80);
    CHECK(open.aspect() == 1.5);
    CHECK(open.name() == "tripod");
    CHECK_FALSE(open.clip_box());
    CHECK(open.view(pose).eye == glm::dvec3(0, 1, 5));
    CHECK(open.view(pose).pixels_down == 80.0);

    const engine::RenderCamera square(builder.scene, {}, "auto", 120, 120);
    CHECK(square.aspect() == 1.0);
    CHECK(square.view(pose).half_width == Approx(square.view(pose).half_height));
}

TEST_CASE("without a camera node the view fits the clip", "[engine]") {
    const auto builder = floor_and_camera();
    const engine::RenderCamera camera(builder.scene, {}, "fit", 160, std::nullopt);
    CHECK(camera.height() == 90);
    CHECK(camera.name() == "fit");
    REQUIRE(camera.clip_box());
    CHECK(camera.clip_box()->min == glm::vec3(-2, 0, -2));
    CHECK(camera.clip_box()->max == glm::vec3(2, 0, 2));
    CHECK(camera.view(anim::pose(builder.scene, {}, 0.0)).eye ==
          engine::fitting_view({-2, 0, -2}, {2, 0, 2}, 160, 90).eye);
}

TEST_CASE("a scene without triangles is framed as a point at the origin", "[engine]") {
    const test::SceneBuilder nothing;
    const engine::RenderCamera camera(nothing.scene, {}, "auto", 160, 90);
    REQUIRE(camera.clip_box());
    CHECK(camera.clip_box()->empty());
    CHECK(camera.view(anim::pose(nothing.scene, {}, 0.0)).eye ==
          engine::fitting_view(glm::dvec3(0.0), glm::dvec3(0.0), 160, 90).eye);
}
