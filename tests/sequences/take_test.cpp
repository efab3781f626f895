#include "sequences/take.h"

#include "anim/clip.h"
#include "sequences/errors.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace gridreel;
using namespace gridreel::sequences;

TEST_CASE("without a list the frames are the whole clip", "[take]") {
    const anim::Clip clip{.animations = {}, .duration_s = 0.125};
    CHECK(choose_frames({}, {}, clip, FramePattern("####.exr")) == std::vector<Frame>{0, 1, 2, 3});
    CHECK_THROWS_AS(choose_frames({}, {}, clip, FramePattern("one.exr")), UsageError);
}

TEST_CASE("a clip of too many frames must be cut by hand", "[take]") {
    Take take;
    take.rate = parse_frame_rate("10");
    const FramePattern output("####.exr");
    CHECK(choose_frames(take, {}, {.animations = {}, .duration_s = 99'999.0}, output).size() == 999'991);
    for (const double duration_s : {1e6, 1e30}) {
        CHECK_THROWS_AS(choose_frames(take, {}, {.animations = {}, .duration_s = duration_s}, output),
                        UsageError);
    }
    take.frames = {7};
    CHECK(choose_frames(take, {}, {.animations = {}, .duration_s = 1e6}, output) == std::vector<Frame>{7});
}

TEST_CASE("the last frame of a clip can be asked for by name, and comes once", "[take]") {
    const anim::Clip clip{.animations = {}, .duration_s = 2.0};  // frames 0 to 48
    Take take;
    const auto frames_of = [&](const char* list, const anim::Clip& played) {
        take.frames = parse_frame_list(list);
        return choose_frames(take, {}, played, FramePattern("####.exr"));
    };
    CHECK(frames_of("5,last", clip) == std::vector<Frame>{5, 48});
    CHECK(frames_of("last,5,48", clip) == std::vector<Frame>{5, 48});
    CHECK(frames_of("60,last", clip) == std::vector<Frame>{60, 48});
    CHECK(frames_of("last", {}) == std::vector<Frame>{0});
    CHECK_THROWS_AS(frames_of("last", {.animations = {}, .duration_s = 1e30}), UsageError);
}

TEST_CASE("a loop leaves its last frame out when that repeats the first", "[take]") {
    // Up and down again within two seconds.
    anim::Scene scene;
    scene.nodes.resize(1);
    scene.scenes = {{0}};
    const anim::Sampler there_and_back{
        .times_s = {0, 1, 2}, .values = {0, 0, 0, 0, 1, 0, 0, 0, 0}, .width = 3};
    scene.animations = {{.name = "bob", .samplers = {there_and_back}, .channels = {{}}}};
    const anim::Clip clip = anim::choose_clip(scene);
    const FramePattern output("####.exr");
    Take take;
    take.loop = true;
    const auto last_at = [&](const char* fps) {
        take.rate = parse_frame_rate(fps);
        return choose_frames(take, scene, clip, output).back();
    };

    CHECK(last_at("24") == 47);
    CHECK(last_at("0.75") == 1);  // 1.33 s of 2: not back yet
    CHECK(choose_frames(take, scene, {}, output) == std::vector<Frame>{0});
    take.frames = {48};
    CHECK(last_at("24") == 48);
    take.frames.reset();
    take.loop = false;
    CHECK(last_at("24") == 48);
    take.loop = true;
    scene.animations[0].samplers[0].values[7] = 0.5f;  // comes to rest higher up
    CHECK(last_at("24") == 48);
}
