#include "sequences/frame_rate.h"
#include "sequences/errors.h"

#include <catch2/catch.hpp>

#include <string>

using namespace gridreel::sequences;

TEST_CASE("frame rates are numbers or ratios", "[frame_rate]") {
    CHECK(parse_frame_rate("24") == FrameRate{.numerator = 24, .denominator = 1});
    CHECK(parse_frame_rate("39.95") == FrameRate{.numerator = 39.95, .denominator = 1});
    CHECK(parse_frame_rate("30000/1001") == FrameRate{.numerator = 30000, .denominator = 1001});
    for (const std::string text :
         {"", "0", "-24", "24fps", "1/0", "/", "24/", "/24", "nan", "inf", "1/2/3", "1e9"}) {
        INFO(text);
        CHECK_THROWS_AS(parse_frame_rate(text), UsageError);
    }
    for (const std::string text : {"24", "39.95", "30000/1001"})
        CHECK(to_string(parse_frame_rate(text)) == text);
}

TEST_CASE("a frame's time comes from the frame alone, in double", "[frame_rate]") {
    CHECK(parse_frame_rate("24").time_of(12) == 0.5);
    CHECK(parse_frame_rate("24").time_of(1) == 1.0 / 24.0);
    CHECK(parse_frame_rate("24").time_of(-12) == -0.5);
    CHECK(parse_frame_rate("39.95").time_of(47) == 47.0 / 39.95);
    CHECK(parse_frame_rate("30000/1001").time_of(1001) == 1001.0 * 1001.0 / 30000.0);
}

TEST_CASE("the last frame of a clip includes its last key", "[frame_rate]") {
    const FrameRate film = parse_frame_rate("24");
    CHECK(last_frame(0.0, film) == 0);
    CHECK(last_frame(2.0, film) == 48);
    CHECK(last_frame(2.02, film) == 48);
    CHECK(last_frame(2.04, film) == 48);
    CHECK(last_frame(2.05, film) == 49);
    CHECK(last_frame(1.0, parse_frame_rate("30000/1001")) == 29);
}

TEST_CASE("a last key that float rounding moved below its frame still counts", "[frame_rate]") {
    const FrameRate film = parse_frame_rate("24");
    CHECK(last_frame(2.0833333, film) == 50);  // 49.9999992
    CHECK(last_frame(double(2.0833333f), film) == 50);
    CHECK(last_frame(double(0.041666666f), film) == 1);
    CHECK(last_frame(double(float(86399.0 / 24.0)), film) == 86399);  // an hour: floats are 0.0002 s apart
    CHECK(last_frame(2.083, film) == 49);                             // 49.992 is another matter
    // Every whole frame of ten minutes at awkward rates.
    for (const std::string text : {"24", "25", "30000/1001", "39.95", "60"}) {
        const FrameRate rate = parse_frame_rate(text);
        Frame wrong = 0;
        for (Frame frame = 0; frame <= 36'000; ++frame) {
            wrong += last_frame(double(float(rate.time_of(frame))), rate) != frame;
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("clips of any length have a last frame", "[frame_rate]") {
    CHECK(last_frame(1e6, parse_frame_rate("24")) == 24'000'002);  // 24e6 float epsilons are 2.86 frames
    CHECK(last_frame(1e30, parse_frame_rate("24")) == Frame{1} << 53);
}
