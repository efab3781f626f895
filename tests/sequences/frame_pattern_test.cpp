#include "sequences/frame_pattern.h"
#include "sequences/errors.h"
#include "sequences/job.h"

#include <catch2/catch.hpp>

#include <string>

using namespace gridreel::sequences;

TEST_CASE("a run of hashes is at least as many digits", "[frame_pattern]") {
    const FramePattern pattern("out/fox.####.exr");
    CHECK(pattern.has_number());
    CHECK(pattern.path(7) == "out/fox.0007.exr");
    CHECK(pattern.path(0) == "out/fox.0000.exr");
    CHECK(pattern.path(12345) == "out/fox.12345.exr");
    CHECK(pattern.path(-7) == "out/fox.-0007.exr");
    CHECK(FramePattern("#.png").path(12) == "12.png");
}

TEST_CASE("percent patterns are those of printf", "[frame_pattern]") {
    CHECK(FramePattern("a_%04d.png").path(7) == "a_0007.png");
    CHECK(FramePattern("a_%04d.png").path(-7) == "a_-007.png");
    CHECK(FramePattern("a_%d.png").path(7) == "a_7.png");
    CHECK(FramePattern("100%.%03d.png").path(5) == "100%.005.png");
}

TEST_CASE("a pattern without a number always names the same file", "[frame_pattern]") {
    const FramePattern pattern("still.exr");
    CHECK_FALSE(pattern.has_number());
    CHECK(pattern.path(3) == "still.exr");
    CHECK_FALSE(FramePattern("50%d/still.exr").has_number());
    CHECK(FramePattern("C#/still.exr").path(3) == "C#/still.exr");
}

TEST_CASE("a pattern needs one name and one place for the number", "[frame_pattern]") {
    for (const std::string text : {"", "out/", "##.##.exr", "#_%04d.exr", "..", "."}) {
        INFO(text);
        CHECK_THROWS_AS(FramePattern(text), UsageError);
    }
}

TEST_CASE("a pattern knows its parts", "[frame_pattern]") {
    CHECK(FramePattern("out/fox.####.exr").extension() == ".exr");
    CHECK(FramePattern("out/fox.####.EXR").extension() == ".exr");
    CHECK(FramePattern("out/fox.####").extension().empty());
    CHECK(FramePattern("out/fox.####.exr").folder() == "out");
    CHECK(FramePattern("fox.####.exr").folder().empty());
    CHECK(FramePattern("out/fox.####.exr").stem() == "fox");
    CHECK(FramePattern("out/fox_%04d.exr").stem() == "fox");
    CHECK(FramePattern("out/####.exr").stem().empty());
    CHECK(FramePattern("still.exr").stem() == "still");
    CHECK(FramePattern("out/fox_%04d.exr").text() == "out/fox_%04d.exr");
}

TEST_CASE("output and log have their places when nobody names them", "[frame_pattern]") {
    CHECK(default_output("a/Fox.glb", ".exr").path(7) == "frames/Fox.0007.exr");
    CHECK(default_output("a/C#.v%04d.glb", ".exr").path(7) == "frames/C#.v%04d.0007.exr");
    CHECK(default_log(FramePattern("out/fox.####.exr"), "a/Fox.glb") == "out/fox.jsonl");
    CHECK(default_log(FramePattern("out/####.exr"), "a/Fox.glb") == "out/Fox.jsonl");
    CHECK(default_log(default_output("a/Fox.glb", ".exr"), "a/Fox.glb") == "frames/Fox.jsonl");
}
