#include "gltf_builder.h"

#include <catch2/catch.hpp>

using namespace gridreel;
using Catch::Matchers::Contains;

TEST_CASE("nodes keep their transforms, names and families", "[load]") {
    auto file = test::one_triangle();
    file.json["nodes"] = {
        {{"name", "root"},
         {"children", {2, 1}},
         {"translation", {1, 2, 3}},
         {"rotation", {0.5, -0.5, 0.5, 0.5}}},
        {{"scale", {2, 3, 4}}, {"mesh", 0}},
        {{"matrix", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16}}},
    };
    const auto scene = file.load();

    REQUIRE(scene.nodes.size() == 3);
    CHECK(scene.nodes[0].name == "root");
    CHECK(scene.nodes[0].children == std::vector<anim::Index>{2, 1});
    CHECK_FALSE(scene.nodes[0].parent);
    CHECK(scene.nodes[1].parent == 0u);
    CHECK(scene.nodes[2].parent == 0u);
    CHECK(scene.nodes[0].trs.translation == glm::dvec3(1, 2, 3));
    CHECK(scene.nodes[0].trs.rotation == glm::dquat(0.5, 0.5, -0.5, 0.5));  // w, x, y, z
    CHECK(scene.nodes[0].trs.scale == glm::dvec3(1));
    CHECK_FALSE(scene.nodes[0].matrix);
    CHECK(scene.nodes[1].trs.scale == glm::dvec3(2, 3, 4));
    CHECK(scene.nodes[1].mesh == 0u);
    CHECK(scene.nodes[1].trs.rotation == glm::dquat(1, 0, 0, 0));
    REQUIRE(scene.nodes[2].matrix);
    CHECK((*scene.nodes[2].matrix)[3] == glm::dvec4(13, 14, 15, 16));  // column-major
    CHECK_FALSE(scene.nodes[2].mesh);
}

TEST_CASE("the file's default scene is the first unless it says otherwise", "[load]") {
    auto file = test::one_triangle();
    file.json["scenes"] = {{{"nodes", {0}}}, nlohmann::json::object()};
    SECTION("stated") {
        file.json["scene"] = 1;
        CHECK(file.load().default_scene == 1);
        CHECK(file.load().scenes.at(1).empty());
    }
    SECTION("not stated") {
        file.json.erase("scene");
        CHECK(file.load().default_scene == 0);
    }
}

TEST_CASE("a file without scenes shows all its roots, with a warning", "[load]") {
    auto file = test::one_triangle();
    file.json.erase("scene");
    file.json.erase("scenes");
    file.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}}, {{"mesh", 0}}};
    const auto scene = file.load();
    CHECK(scene.scenes == std::vector<std::vector<anim::Index>>{{0, 2}});
    CHECK_THAT(test::warning_at(scene, ""), Contains("no scene"));
}

TEST_CASE("skins have one inverse bind matrix per joint", "[load]") {
    auto file = test::skinned_triangle();
    SECTION("identity when the file has none") {
        const auto skin = file.load().skins.at(0);
        CHECK(skin.joints == std::vector<anim::Index>{1, 2});
        CHECK(skin.inverse_bind == std::vector<glm::dmat4>{glm::dmat4(1), glm::dmat4(1)});
    }
    SECTION("as stored, surplus ones left out") {
        std::vector<float> values;
        for (int i = 0; i < 48; ++i) values.push_back(float(i));
        file.json["skins"][0]["inverseBindMatrices"] = file.add_accessor(values, test::float32, "MAT4", 3);
        const auto skin = file.load().skins.at(0);
        REQUIRE(skin.inverse_bind.size() == 2);
        CHECK(skin.inverse_bind[1][0] == glm::dvec4(16, 17, 18, 19));
    }
}

TEST_CASE("cameras keep what the file leaves open open", "[load]") {
    auto file = test::one_triangle();
    file.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.25}}}},
        {{"name", "close"},
         {"type", "perspective"},
         {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 100}, {"aspectRatio", 1.5}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 10}}}},
    };
    file.json["nodes"][0]["camera"] = 1;
    const auto scene = file.load();

    REQUIRE(scene.cameras.size() == 3);
    CHECK(scene.nodes[0].camera == 1u);
    CHECK(scene.cameras[0].kind == anim::Camera::Kind::perspective);
    CHECK(scene.cameras[0].fov_y_rad == 0.5);
    CHECK(scene.cameras[0].near_m == 0.25);
    CHECK(scene.cameras[0].far_m == std::numeric_limits<double>::infinity());
    CHECK_FALSE(scene.cameras[0].aspect);
    CHECK(scene.cameras[1].name == "close");
    CHECK(scene.cameras[1].aspect == 1.5);
    CHECK(scene.cameras[1].far_m == 100.0);
    CHECK(scene.cameras[2].kind == anim::Camera::Kind::orthographic);
    CHECK(scene.cameras[2].x_mag == 2.0);
    CHECK(scene.cameras[2].y_mag == 3.0);
    CHECK(scene.cameras[2].far_m == 10.0);
}

TEST_CASE("punctual lights are read with the extension's defaults", "[load]") {
    auto file = test::one_triangle();
    file.json["extensionsUsed"] = {"KHR_lights_punctual"};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}},
        {{"type", "directional"}, {"color", {1, 0.5, 0.25}}, {"intensity", 3}, {"name", "sun"}},
        {{"type", "spot"}, {"range", 7}, {"spot", {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}}}},
        {{"type", "spot"}, {"spot", nlohmann::json::object()}},
    };
    file.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 2;
    const auto scene = file.load();

    REQUIRE(scene.lights.size() == 4);
    CHECK(scene.nodes[0].light == 2u);
    CHECK(scene.lights[0].kind == anim::Light::Kind::point);
    CHECK(scene.lights[0].color == glm::vec3(1));
    CHECK(scene.lights[0].intensity == 1.0f);
    CHECK_FALSE(scene.lights[0].range_m);
    CHECK(scene.lights[1].kind == anim::Light::Kind::directional);
    CHECK(scene.lights[1].color == glm::vec3(1, 0.5f, 0.25f));
    CHECK(scene.lights[1].intensity == 3.0f);
    CHECK(scene.lights[1].name == "sun");
    CHECK(scene.lights[2].kind == anim::Light::Kind::spot);
    CHECK(scene.lights[2].range_m == 7.0f);
    CHECK(scene.lights[2].inner_cone_rad == 0.25f);
    CHECK(scene.lights[2].outer_cone_rad == 0.5f);
    CHECK(scene.lights[3].inner_cone_rad == 0.0f);
    CHECK(scene.lights[3].outer_cone_rad == Approx(0.785398));
    CHECK(scene.warnings.empty());
}
