#include "sequences/take.h"
#include "sequences/errors.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace gridreel;
using namespace gridreel::sequences;

TEST_CASE("without a list the frames are the whole clip", "[take]") {
    const anim::Clip clip{.animations = {}, .duration_s = 0.125};
    CHECK(choose_frames({}, clip, FramePattern("####.exr")) == std::vector<Frame>{0, 1, 2, 3});
    CHECK_THROWS_AS(choose_frames({}, clip, FramePattern("one.exr")), UsageError);
}

TEST_CASE("a clip of too many frames must be cut by hand", "[take]") {
    Take take;
    take.rate = parse_frame_rate("10");
    const FramePattern output("####.exr");
    CHECK(choose_frames(take, {.animations = {}, .duration_s = 99'999.0}, output).size() == 999'991);
    for (const double duration_s : {1e6, 1e30}) {
        CHECK_THROWS_AS(choose_frames(take, {.animations = {}, .duration_s = duration_s}, output),
                        UsageError);
    }
    take.frames = {7};
    CHECK(choose_frames(take, {.animations = {}, .duration_s = 1e6}, output) == std::vector<Frame>{7});
}

TEST_CASE("the last frame of a clip can be asked for by name, and comes once", "[take]") {
    const anim::Clip clip{.animations = {}, .duration_s = 2.0};  // frames 0 to 48
    Take take;
    const auto frames_of = [&](const char* list, const anim::Clip& played) {
        take.frames = parse_frame_list(list);
        return choose_frames(take, played, FramePattern("####.exr"));
    };
    CHECK(frames_of("5,last", clip) == std::vector<Frame>{5, 48});
    CHECK(frames_of("last,5,48", clip) == std::vector<Frame>{5, 48});
    CHECK(frames_of("60,last", clip) == std::vector<Frame>{60, 48});
    CHECK(frames_of("last", {}) == std::vector<Frame>{0});
    CHECK_THROWS_AS(frames_of("last", {.animations = {}, .duration_s = 1e30}), UsageError);
}
