#include "sequences/progress.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace gridreel::sequences;

namespace {

FrameRecord some_frame() {
    FrameRecord frame;
    frame.frame = 11;
    frame.render.rebuild.total_ms = 2.5;
    frame.render.trace_ms = 40.25;
    frame.file = "out/a.0011.exr";
    return frame;
}

bool has_control_characters(const std::string& text) {
    return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; });
}

}  // namespace

TEST_CASE("pace and time left follow from the frames done", "[progress]") {
    const Progress progress{.done = 12, .total = 240, .elapsed_s = 6.0};
    CHECK(progress.frames_per_second() == 2.0);
    CHECK(progress.left_s() == 114.0);
    CHECK(Progress{.done = 0, .total = 5, .elapsed_s = 0.0}.left_s() == 0.0);
}

TEST_CASE("clock times", "[progress]") {
    CHECK(clock_text(7) == "0:07");
    CHECK(clock_text(754) == "12:34");
    CHECK(clock_text(3723) == "1:02:03");
    CHECK(clock_text(59.6) == "1:00");
}

TEST_CASE("the bar shows frame, pace, time left, rebuild and trace", "[progress]") {
    const std::string bar = progress_bar({.done = 12, .total = 240, .elapsed_s = 6.0}, some_frame(), 120);
    CHECK(bar.size() <= 120);
    for (const char* part :
         {"12/240", "frame 11", "2.00 frames/s", "1:54 left", "rebuild 2.5 ms", "trace 40.2 ms"}) {
        INFO(part);
        CHECK(bar.find(part) != std::string::npos);
    }
    CHECK(bar.starts_with("[=     "));  // 12/240 of 30
    CHECK_FALSE(has_control_characters(bar));
}

TEST_CASE("the bar never exceeds the terminal", "[progress]") {
    for (std::size_t columns = 0; columns < 150; ++columns) {
        CHECK(progress_bar({.done = 240, .total = 240, .elapsed_s = 6.0}, some_frame(), columns).size() <=
              columns);
    }
    const std::string full = progress_bar({.done = 240, .total = 240, .elapsed_s = 6.0}, some_frame(), 150);
    CHECK(full.starts_with("[" + std::string(30, '=') + "]"));
}

TEST_CASE("a plain line says where the frame went, or why not", "[progress]") {
    FrameRecord frame = some_frame();
    const std::string line = progress_line({.done = 12, .total = 240, .elapsed_s = 6.0}, frame);
    CHECK(line.find("12/240 frame 11 -> out/a.0011.exr") == 0);
    CHECK_FALSE(has_control_characters(line));
    frame.error = "no light";
    CHECK(progress_line({.done = 12, .total = 240, .elapsed_s = 6.0}, frame) ==
          "12/240 frame 11 failed: no light");
}
