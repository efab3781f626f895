#include "sequences/frame_list.h"
#include "sequences/errors.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace gridreel::sequences;
using Frames = std::vector<Frame>;

TEST_CASE("frame lists read every form that the manual shows", "[frame_list]") {
    CHECK(parse_frame_list("7") == Frames{7});
    CHECK(parse_frame_list("1-4") == Frames{1, 2, 3, 4});
    CHECK(parse_frame_list("1-10x3") == Frames{1, 4, 7, 10});
    CHECK(parse_frame_list("1-9x3") == Frames{1, 4, 7});
    CHECK(parse_frame_list("1,5,10-12") == Frames{1, 5, 10, 11, 12});
    CHECK(parse_frame_list("-5--1") == Frames{-5, -4, -3, -2, -1});
    CHECK(parse_frame_list("-2-1") == Frames{-2, -1, 0, 1});
    CHECK(parse_frame_list("3-3") == Frames{3});
    CHECK(parse_frame_list("last") == Frames{clip_end});
    CHECK(parse_frame_list("last,0-2,last") == Frames{clip_end, 0, 1, 2});
}

TEST_CASE("a frame list keeps its order and drops second mentions", "[frame_list]") {
    CHECK(parse_frame_list("5,1-3,2,5") == Frames{5, 1, 2, 3});
    CHECK(parse_frame_list("1-4,0-10x2") == Frames{1, 2, 3, 4, 0, 6, 8, 10});
}

TEST_CASE("anything else is not a frame list", "[frame_list]") {
    for (const std::string text : {"",
                                   ",",
                                   "1,",
                                   ",1",
                                   "a",
                                   "1-",
                                   "-",
                                   "1--",
                                   "5-1",
                                   "1-5x0",
                                   "1-5x-1",
                                   "1-5x",
                                   "1x2",
                                   "1.5",
                                   "1 - 5",
                                   "1-5x2x2",
                                   "+3",
                                   "1-2-3",
                                   "99999999999999999999",
                                   "1000000001",
                                   "0-last",
                                   "lastx2",
                                   "Last",
                                   " last"}) {
        INFO(text);
        CHECK_THROWS_AS(parse_frame_list(text), UsageError);
    }
}

TEST_CASE("a frame list too long to render is refused before it is written out", "[frame_list]") {
    CHECK(parse_frame_list("1-1000000").size() == max_frames);
    CHECK_THROWS_AS(parse_frame_list("0-1000000"), UsageError);
    CHECK_THROWS_AS(parse_frame_list("-1000000000-1000000000"), UsageError);
    CHECK_THROWS_AS(parse_frame_list("1-600000,1000001-1600000"), UsageError);
    CHECK(parse_frame_list("0-1000000000x100000").size() == 10'001);
}

TEST_CASE("a frame list's text reads back as the same frames", "[frame_list]") {
    for (const std::string text : {"7", "1-240", "1,5,10-20", "-5--1", "3,1-2"}) {
        CHECK(to_string(parse_frame_list(text)) == text);
    }
    CHECK(to_string(parse_frame_list("1-9x4")) == "1,5,9");
    CHECK(to_string(Frames{}).empty());
}
