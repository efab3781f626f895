// Choosing what plays, and the order of nodes.

#include "anim/clip.h"

#include "anim/error.h"
#include "scene_builder.h"

#include <catch2/catch.hpp>

namespace gridreel::anim {
namespace {

using testing::add_animation;
using testing::add_node;
using testing::drive;
using testing::keys;

Sampler still_until(float time_s) {
    return keys(Interpolation::linear, 3, {time_s}, {0, 0, 0});
}

/// "walk" moves node 0 until 2 s, "nod" moves node 1 until 3.5 s.
Scene walk_and_nod() {
    Scene scene = testing::empty_scene();
    add_node(scene, {});
    add_node(scene, {});
    drive(scene, add_animation(scene, "walk"), 0, ChannelPath::translation, still_until(2.0f));
    drive(scene, add_animation(scene, "nod"), 1, ChannelPath::translation, still_until(3.5f));
    return scene;
}

using Indices = std::vector<Index>;

TEST_CASE("animations of different nodes play together", "[anim]") {
    const Clip clip = choose_clip(walk_and_nod());

    CHECK(clip.animations == Indices{0, 1});
    CHECK(clip.duration_s == 3.5);
}

TEST_CASE("animations of different properties of a node play together", "[anim]") {
    Scene scene = walk_and_nod();
    drive(scene, add_animation(scene, "grow"), 0, ChannelPath::scale, still_until(1.0f));

    CHECK(choose_clip(scene).animations == Indices{0, 1, 2});
}

TEST_CASE("of animations that drive the same property only the first plays", "[anim]") {
    Scene scene = walk_and_nod();
    drive(scene, add_animation(scene, "run"), 0, ChannelPath::translation, still_until(9.0f));
    const Clip clip = choose_clip(scene);

    CHECK(clip.animations == Indices{0});
    CHECK(clip.duration_s == 2.0);
    CHECK(choose_clip(scene, "all").animations == Indices{0, 1, 2});
    CHECK(choose_clip(scene, "all").duration_s == 9.0);
}

TEST_CASE("a clip lasts as long as its longest animation, first or last", "[anim]") {
    Scene scene = walk_and_nod();
    scene.animations[0].samplers[0].times_s = {0.5f, 4.0f};

    CHECK(choose_clip(scene, "all").duration_s == 4.0);
}

TEST_CASE("an animation is chosen by name or number", "[anim]") {
    const Scene scene = walk_and_nod();

    CHECK(choose_clip(scene, "nod").animations == Indices{1});
    CHECK(choose_clip(scene, "nod").duration_s == 3.5);
    CHECK(choose_clip(scene, "0").animations == Indices{0});
    CHECK(choose_clip(scene, "1").animations == Indices{1});
    CHECK(choose_clip(scene, "none").animations.empty());
    CHECK(choose_clip(scene, "none").duration_s == 0.0);
}

TEST_CASE("an animation's name wins over a number", "[anim]") {
    Scene scene = walk_and_nod();
    add_animation(scene, "0");

    CHECK(choose_clip(scene, "0").animations == Indices{2});
}

TEST_CASE("an animation that does not exist is an error that names those that do", "[anim]") {
    const auto choice = GENERATE("sleep", "2", "-1", "1x", "");
    const Scene scene = walk_and_nod();

    try {
        const Clip clip = choose_clip(scene, choice);
        FAIL("chose " << clip.animations.size() << " animations");
    } catch (const Error& error) {
        CHECK(error.where() == "--animation");
        CHECK(error.remedy().find("\"walk\"") != std::string::npos);
        CHECK(error.remedy().find("\"nod\"") != std::string::npos);
    }
}

TEST_CASE("a scene without animations is a still", "[anim]") {
    const Scene scene = testing::empty_scene();

    CHECK(choose_clip(scene).animations.empty());
    CHECK(choose_clip(scene, "all").animations.empty());
    CHECK_THROWS_AS(choose_clip(scene, "0"), Error);
}

TEST_CASE("the file's default scene is shown unless another is asked for", "[anim]") {
    Scene scene = walk_and_nod();
    scene.scenes = {{0}, {1}};
    scene.default_scene = 1;

    CHECK(choose_clip(scene).scene == 1);
    CHECK(choose_clip(scene, "auto", 0).scene == 0);
    CHECK_THROWS_AS(choose_clip(scene, "auto", 2), Error);
}

TEST_CASE("by itself nothing plays that only moves nodes of other scenes", "[anim]") {
    Scene scene = walk_and_nod();
    scene.scenes = {{0}, {1}, {0, 1}, {}};
    CHECK(choose_clip(scene, "auto", 0).animations == Indices{0});
    CHECK(choose_clip(scene, "auto", 0).duration_s == 2.0);
    CHECK(choose_clip(scene, "auto", 1).animations == Indices{1});
    CHECK(choose_clip(scene, "auto", 2).animations == Indices{0, 1});
    CHECK(choose_clip(scene, "auto", 3).animations.empty());
    CHECK(choose_clip(scene, "all", 0).animations == Indices{0, 1});

    // Joints may stand in no scene, and looks in all.
    scene.scenes = {{1}};
    CHECK(choose_clip(scene).animations == Indices{0, 1});
    scene.scenes = {{0}, {1}};
    scene.materials.resize(1);
    drive(scene, add_animation(scene, "glow"), 0, ChannelPath::material, still_until(1.0f));
    CHECK(choose_clip(scene, "auto", 1).animations == Indices{1, 2});
}

TEST_CASE("samplers that no channel uses do not lengthen a clip", "[anim]") {
    Scene scene = walk_and_nod();
    scene.animations[0].samplers.push_back(still_until(100.0f));

    CHECK(choose_clip(scene, "all").duration_s == 3.5);
}

TEST_CASE("nodes come depth first, children and roots in file order", "[anim]") {
    Scene scene = testing::empty_scene();
    const Index b = add_node(scene, {});
    const Index a = add_node(scene, {});
    const Index b1 = add_node(scene, {}, b);
    const Index b2 = add_node(scene, {}, b);
    const Index a1 = add_node(scene, {}, a);
    const Index b1x = add_node(scene, {}, b1);
    testing::add_hidden_root(scene, {});
    scene.scenes[0] = {a, b};

    CHECK(nodes_in_order(scene, choose_clip(scene)) == Indices{a, a1, b, b1, b1x, b2});
}

TEST_CASE("a chain of a hundred thousand nodes is walked without recursion", "[anim]") {
    Scene scene = testing::empty_scene();
    add_node(scene, {});
    for (Index node = 1; node < 100'000; ++node) add_node(scene, {}, node - 1);

    CHECK(nodes_in_order(scene, choose_clip(scene)).back() == 99'999);
}

}  // namespace
}  // namespace gridreel::anim
