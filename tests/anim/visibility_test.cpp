// KHR_node_visibility: what is hidden has no triangles, at rest and while a pointer drives it.

#include "anim/clip_bounds.h"
#include "anim/frame_geometry.h"
#include "anim/pose.h"
#include "gltf_builder.h"
#include "scene_builder.h"

#include <catch2/catch.hpp>

namespace gridreel::anim {
namespace {

using testing::add_mesh;
using testing::add_node;
using testing::frame_at;
using testing::keys;
using testing::moved;
using testing::placed;

/// Nodes 0 (parent), 1 and 2 (children), 3: a triangle each, at x = 0, 1, 2, 3.
Scene four_triangles() {
    Scene scene = testing::empty_scene();
    const Index mesh = add_mesh(scene, testing::triangle());
    add_node(scene, placed(moved(0, 0, 0), mesh));
    add_node(scene, placed(moved(1, 0, 0), mesh), 0);
    add_node(scene, placed(moved(2, 0, 0), mesh), 0);
    add_node(scene, placed(moved(3, 0, 0), mesh));
    return scene;
}

/// Shown from 1 s until 2 s.
Sampler flash() {
    return keys(Interpolation::step, 1, {0, 1, 2}, {0, 1, 0});
}

/// Where the triangles of the frame stand.
std::vector<float> places(const FrameGeometry& frame) {
    std::vector<float> all;
    for (const glm::uvec3& triangle : frame.triangles) all.push_back(frame.positions[triangle.x].x);
    return all;
}

TEST_CASE("what hangs below a hidden node is not laid out", "[anim][visibility]") {
    Scene scene = four_triangles();
    scene.nodes[0].visible = false;
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(places(frame) == std::vector<float>{3});
    CHECK(frame.parts.size() == 1);
    CHECK(clip_bounds(scene, choose_clip(scene)).min.x == 3.0f);
}

TEST_CASE("a flag keeps its key's value until the next key", "[anim][visibility]") {
    Scene scene = four_triangles();
    testing::drive(scene, testing::add_animation(scene), 1, ChannelPath::visibility, flash());

    CHECK(places(frame_at(scene, 0.0)) == std::vector<float>{0, 2, 3});
    CHECK(places(frame_at(scene, 0.999)) == std::vector<float>{0, 2, 3});
    CHECK(places(frame_at(scene, 1.0)) == std::vector<float>{0, 1, 2, 3});
    CHECK(places(frame_at(scene, 1.999)) == std::vector<float>{0, 1, 2, 3});
    CHECK(places(frame_at(scene, 2.0)) == std::vector<float>{0, 2, 3});
}

TEST_CASE("a shown node below one that is hidden for a while is hidden with it", "[anim][visibility]") {
    Scene scene = four_triangles();
    const Index animation = testing::add_animation(scene);
    testing::drive(scene, animation, 0, ChannelPath::visibility, flash());
    testing::drive(scene, animation, 1, ChannelPath::visibility, keys(Interpolation::step, 1, {0}, {1}));

    CHECK(places(frame_at(scene, 0.5)) == std::vector<float>{3});
    CHECK(places(frame_at(scene, 1.5)) == std::vector<float>{0, 1, 2, 3});
}

TEST_CASE("an animation that always shows a node overrides its own flag, and one that never does hides it",
          "[anim][visibility]") {
    Scene scene = four_triangles();
    scene.nodes[3].visible = false;
    const Index animation = testing::add_animation(scene);
    testing::drive(scene, animation, 3, ChannelPath::visibility,
                   keys(Interpolation::step, 1, {0, 1}, {1, 255}));
    testing::drive(scene, animation, 1, ChannelPath::visibility,
                   keys(Interpolation::step, 1, {0, 1}, {0, 0}));
    const FrameGeometry frame = frame_at(scene, 0.0);

    CHECK(places(frame) == std::vector<float>{0, 2, 3});
    CHECK(frame.parts.size() == 3);
    CHECK_FALSE(frame.parts[2].blinks);
}

TEST_CASE("a camera that fits sees parts where they are shown", "[anim][visibility]") {
    // Node 3 waits far away until it is shown, at x = 3 from 1 s on.
    Scene scene = four_triangles();
    const Index animation = testing::add_animation(scene);
    testing::drive(scene, animation, 3, ChannelPath::visibility,
                   keys(Interpolation::step, 1, {0, 1, 2}, {0, 1, 1}));
    testing::drive(scene, animation, 3, ChannelPath::translation,
                   keys(Interpolation::step, 3, {0, 1, 2}, {500, 0, 0, 3, 0, 0, 3, 0, 0}));
    CHECK(clip_bounds(scene, choose_clip(scene)) == Box{.min = {0, 0, 0}, .max = {4, 1, 0}});
}

TEST_CASE("a flash that no sampled time meets counts all the same", "[anim][visibility]") {
    Scene scene = four_triangles();
    const Index animation = testing::add_animation(scene);
    testing::drive(scene, animation, 3, ChannelPath::visibility,
                   keys(Interpolation::step, 1, {0, 0.5f, 0.501f, 31}, {0, 1, 0, 0}));
    // It moves meanwhile, so that all times are looked at.
    testing::drive(scene, animation, 3, ChannelPath::translation,
                   keys(Interpolation::linear, 3, {0, 31}, {5, 0, 0, 9, 0, 0}));
    CHECK(clip_bounds(scene, choose_clip(scene)).max.x == 10.0f);
}

TEST_CASE("frame after frame, triangles come and go with their parts", "[anim][visibility]") {
    Scene scene = four_triangles();
    testing::drive(scene, testing::add_animation(scene), 1, ChannelPath::visibility, flash());
    const Clip clip = choose_clip(scene);
    FrameGeometry frame = lay_out(scene, clip);
    for (const double time_s : {0.0, 1.0, 2.0, 1.5, 1.6, 0.3}) {
        CAPTURE(time_s);
        deform(scene, pose(scene, clip, time_s), frame);
        const FrameGeometry alone = frame_at(scene, time_s);
        CHECK(frame.triangles == alone.triangles);
        CHECK(frame.triangle_part == alone.triangle_part);
        for (std::size_t p = 0; p < frame.parts.size(); ++p) {
            CHECK(frame.parts[p].first_triangle == alone.parts[p].first_triangle);
            CHECK(frame.parts[p].triangle_count == alone.parts[p].triangle_count);
        }
    }
}

TEST_CASE("visibility does not touch the matrices below", "[anim][visibility]") {
    Scene scene = four_triangles();
    scene.nodes[0].visible = false;
    const Pose posed = pose(scene, choose_clip(scene), 0.0);

    CHECK(posed.visible == std::vector<bool>{false, false, false, true});
    CHECK(posed.world[2][3].x == 2.0);
}

TEST_CASE("the flag is read from the file, and a pointer drives it", "[load][visibility]") {
    auto file = test::one_triangle();
    file.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    CHECK(frame_at(file.load(), 0.0).triangles.empty());

    const auto input = file.add_scalars({0, 1});
    const auto output = file.add_accessor<std::uint8_t>({0, 1}, test::uint8, "SCALAR", 2);
    file.json["animations"] = nlohmann::json::array(
        {{{"samplers", {{{"input", input}, {"output", output}, {"interpolation", "STEP"}}}},
          {"channels",
           {{{"sampler", 0},
             {"target",
              {{"path", "pointer"},
               {"extensions",
                {{"KHR_animation_pointer",
                  {{"pointer", "/nodes/0/extensions/KHR_node_visibility/visible"}}}}}}}}}}}});
    const Scene scene = file.load();
    CHECK(scene.warnings.empty());
    CHECK(frame_at(scene, 0.5).triangles.empty());
    CHECK(frame_at(scene, 1.0).triangles.size() == 1);

    file.json["animations"][0]["samplers"][0]["interpolation"] = "LINEAR";
    const Scene blended = file.load();
    CHECK(frame_at(blended, 0.9).triangles.empty());
    CHECK_THAT(test::warning_at(blended, "/animations/0"), Catch::Matchers::Contains("cannot be blended"));

    file.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = "no";
    CHECK(test::refusal_of(file).pointer == "/nodes/0/extensions/KHR_node_visibility/visible");
}

}  // namespace
}  // namespace gridreel::anim
