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
