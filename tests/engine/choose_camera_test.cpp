#include "engine/choose_camera.h"

#include "anim/error.h"

#include <catch2/catch.hpp>

#include <string>

using namespace gridreel;

namespace {

/// Nodes: 0 "root" over 1 "left" (camera "wide") and 2 "right" (camera "tall"); 3 "other" is in no scene.
anim::Scene two_cameras() {
    anim::Scene scene;
    scene.nodes.resize(4);
    scene.nodes[0].name = "root";
    scene.nodes[0].children = {1, 2};
    scene.nodes[1].name = "left";
    scene.nodes[1].parent = 0;
    scene.nodes[1].camera = 0;
    scene.nodes[2].name = "right";
    scene.nodes[2].parent = 0;
    scene.nodes[2].camera = 1;
    scene.nodes[3].name = "other";
    scene.nodes[3].camera = 0;
    scene.cameras.resize(2);
    scene.cameras[0].name = "wide";
    scene.cameras[0].aspect = 2.0;
    scene.cameras[1].name = "tall";
    scene.cameras[1].kind = anim::Camera::Kind::orthographic;
    scene.cameras[1].x_mag = 1.0;
    scene.cameras[1].y_mag = 4.0;
    scene.scenes = {{0}};
    return scene;
}

}  // namespace

TEST_CASE("a camera is chosen by node name, camera name or number", "[engine]") {
    const anim::Scene scene = two_cameras();
    CHECK(engine::choose_camera(scene, {}, "auto") == 1u);
    CHECK(engine::choose_camera(scene, {}, "right") == 2u);
    CHECK(engine::choose_camera(scene, {}, "tall") == 2u);
    CHECK(engine::choose_camera(scene, {}, "0") == 1u);
    CHECK(engine::choose_camera(scene, {}, "1") == 2u);
    CHECK(!engine::choose_camera(scene, {}, "fit"));
}

TEST_CASE("a node's name counts before a camera's, and both before a number", "[engine]") {
    anim::Scene scene = two_cameras();
    scene.nodes[2].name = "wide";
    CHECK(engine::choose_camera(scene, {}, "wide") == 2u);
    scene.cameras[1].name = "0";
    CHECK(engine::choose_camera(scene, {}, "0") == 2u);
}

TEST_CASE("auto without a camera node means fit", "[engine]") {
    anim::Scene scene = two_cameras();
    scene.scenes = {{}};
    CHECK(!engine::choose_camera(scene, {}, "auto"));
}

TEST_CASE("an unknown camera is an error that lists those there are", "[engine]") {
    const anim::Scene scene = two_cameras();
    for (const std::string choice : {"other", "2", "-1", "Left", ""}) {
        CHECK_THROWS_WITH(engine::choose_camera(scene, {}, choice),
                          Catch::Contains("left") && Catch::Contains("wide") && Catch::Contains("right") &&
                              Catch::Contains("tall"));
    }
}

TEST_CASE("the picture's shape follows the camera", "[engine]") {
    const anim::Scene scene = two_cameras();
    CHECK(engine::preferred_aspect(scene, 1) == Approx(2.0));
    CHECK(engine::preferred_aspect(scene, 2) == Approx(0.25));
    CHECK(engine::preferred_aspect(scene, std::nullopt) == Approx(16.0 / 9.0));
}
