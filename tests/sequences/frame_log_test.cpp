#include "sequences/frame_log.h"
#include "sequences/errors.h"
#include "tests/sequences/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>
#include <vector>

using namespace gridreel;
using namespace gridreel::sequences;
using nlohmann::json;
using test::ScratchFolder;

namespace {

FrameRecord some_frame(Frame number) {
    FrameRecord frame;
    frame.frame = number;
    frame.time_s = 0.5;
    frame.render.animate_ms = 1.5;
    frame.render.rebuild = {.bounds_ms = 0.25,
                            .count_ms = 0.5,
                            .scan_ms = 0.125,
                            .scatter_ms = 0.75,
                            .total_ms = 2.0,
                            .lambda = 0.7f,
                            .resolution = {3, 4, 5},
                            .cells = 60,
                            .references = 1234,
                            .bytes = 4096};
    frame.render.trace_ms = 30.0;
    frame.render.shade_ms = 4.0;
    frame.render.moving_triangles = 7;
    frame.render.still_triangles = 9;
    frame.render.primary = {.rays = 100, .cells = 11, .triangle_tests = 300};
    frame.render.shadow = {.rays = 50, .cells = 7, .triangle_tests = 20};
    frame.render_ms = 40.0;
    frame.write_ms = 8.0;
    frame.peak_bytes = 1'000'000;
    frame.file = "out/a.0012.exr";
    frame.pixels_sha256 = "abc";
    return frame;
}

std::vector<json> lines_of(const std::filesystem::path& file) {
    std::istringstream text(test::bytes_of(file));
    std::vector<json> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
    return lines;
}

}  // namespace

TEST_CASE("a frame's line has the documented fields", "[frame_log]") {
    const std::string line = log_line(some_frame(12));
    CHECK(line.find(R"({"schema":"gridreel.frame/1","frame":12,"time_s":0.5,"triangles":)") == 0);
    CHECK(line.find('\n') == line.size() - 1);
    CHECK(json::parse(line) == json::parse(R"({
        "schema": "gridreel.frame/1", "frame": 12, "time_s": 0.5,
        "triangles": {"moving": 7, "still": 9},
        "grid": {"lambda": 0.7, "cells": [3, 4, 5], "cells_with_nested": 60, "references": 1234, "bytes": 4096},
        "ms": {"animate": 1.5,
               "rebuild": {"bounds": 0.25, "count": 0.5, "scan": 0.125, "scatter": 0.75, "total": 2.0},
               "trace": 30.0, "shade": 4.0, "write": 8.0, "total": 48.0},
        "rays": {"primary": 100, "shadow": 50, "secondary": 0},
        "steps": {"cells": 18, "tests": 320},
        "peak_bytes": 1000000, "file": "out/a.0012.exr", "pixels_sha256": "abc"})"));
}

TEST_CASE("a frame whose lambda was chosen says what it should have cost", "[frame_log]") {
    FrameRecord frame = some_frame(12);
    CHECK_FALSE(json::parse(log_line(frame)).contains("predicted_ms"));
    frame.render.predicted = {.rebuild_ms = 1.0 / 3.0, .trace_ms = 31.5};
    CHECK(json::parse(log_line(frame))["predicted_ms"] == json{{"rebuild", 1.0 / 3.0}, {"trace", 31.5}});
}

TEST_CASE("a failed frame's line says why", "[frame_log]") {
    FrameRecord frame = some_frame(3);
    frame.error = "a \"quoted\"\nreason";
    const json line = json::parse(log_line(frame));
    CHECK(line["frame"] == 3);
    CHECK(line["error"] == "a \"quoted\"\nreason");
    CHECK_FALSE(line.contains("pixels_sha256"));
    CHECK_FALSE(line.contains("ms"));
}

TEST_CASE("the run's line says what ran, how and on what", "[frame_log]") {
    RunRecord run;
    run.job.take.scene_file = "a/Fox.glb";
    run.job.output = FramePattern("out/fox.####.exr");
    run.job.threads = 3;
    run.job.image.aov_z = true;
    run.job.render.tracer.resolution.lambda = 0.4f;
    run.scene_sha256 = "123";
    run.animations = {"Walk", "not \xff UTF-8"};
    run.frames = {1, 2, 3, 7};
    run.width = 640;
    run.height = 360;
    run.instruction_set = "AVX2";
    const json line = json::parse(log_line(run));
    CHECK(line["schema"] == "gridreel.run/1");
    for (const char* field : {"version", "compiler", "cpu"}) CHECK(line[field].get<std::string>().size() > 3);
    CHECK(line["instruction_set"] == "AVX2");
    CHECK(line["threads"] == 3);
    CHECK(line["overlapped"] == json{"write"});
    CHECK(line["scene"]["file"] == "a/Fox.glb");
    CHECK(line["scene"]["sha256"] == "123");
    CHECK(line["animations"][0] == "Walk");
    CHECK(line["frames"] == 4);
    CHECK(line["options"]["frames"] == "1-3,7");
    CHECK(line["options"]["size"] == json{640, 360});
    CHECK(line["options"]["lambda"] == 0.4);
    CHECK(line["options"]["background"] == json{0.18, 0.18, 0.18, 1.0});
    CHECK(line["options"]["aov"] == json{"z"});
    CHECK(line["options"]["depth"] == "half");
    CHECK(line["options"]["accel"] == "grid");

    CHECK(line["options"]["variant"].is_null());
    run.job.take.variant = "night";
    CHECK(json::parse(log_line(run))["options"]["variant"] == "night");

    run.job.render.tracer.lambda = traversal::LambdaRule::by_cost;
    CHECK(json::parse(log_line(run))["options"]["lambda"] == "auto");
}

TEST_CASE("a log grows by runs, each line in place at once", "[frame_log]") {
    const ScratchFolder folder;
    const auto file = folder / "new/a.jsonl";
    {
        FrameLog log(file);
        log.append(some_frame(1));
        CHECK(lines_of(file).size() == 1);
        log.append(some_frame(2));
        CHECK(lines_of(file).size() == 2);
    }
    FrameLog(file).append(some_frame(3));
    const auto lines = lines_of(file);
    REQUIRE(lines.size() == 3);
    CHECK(lines[2]["frame"] == 3);
}

TEST_CASE("a line cut off by a crash does not swallow the next", "[frame_log]") {
    const ScratchFolder folder;
    test::write_file(folder / "a.jsonl", "{\"schema\":\"gridreel.fr");
    FrameLog(folder / "a.jsonl").append(some_frame(1));
    CHECK(test::bytes_of(folder / "a.jsonl") == "{\"schema\":\"gridreel.fr\n" + log_line(some_frame(1)));
}

TEST_CASE("a log that cannot be opened is an OutputError", "[frame_log]") {
    const ScratchFolder folder;
    CHECK_THROWS_AS(FrameLog(folder.path()), OutputError);
    test::write_file(folder / "file", "");
    CHECK_THROWS_AS(FrameLog(folder / "file/a.jsonl"), OutputError);
    CHECK_THROWS_AS(FrameLog("/dev/full").append(some_frame(1)), OutputError);
}
