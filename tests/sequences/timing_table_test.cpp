#include "sequences/timing_table.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace gridreel::sequences;

namespace {

FrameRecord record(double rebuild_ms, double trace_ms) {
    FrameRecord frame;
    frame.render.animate_ms = 1.0;
    frame.render.rebuild.total_ms = rebuild_ms;
    frame.render.trace_ms = trace_ms;
    frame.render.shade_ms = 4.0;
    frame.render_ms = 100.0;
    frame.write_ms = 20.0;
    return frame;
}

/// The words of the row that begins with `name`.
std::vector<std::string> row(const std::string& table, const std::string& name) {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(name + "  ")) continue;
        std::istringstream words(line.substr(name.size()));
        std::vector<std::string> row;
        for (std::string word; words >> word;) row.push_back(word);
        return row;
    }
    return {};
}

using Row = std::vector<std::string>;

}  // namespace

TEST_CASE("a spread's middle is the mean of two when the list is even", "[timing_table]") {
    const Spread odd = spread_of({3.0, 1.0, 10.0});
    CHECK(odd.min == 1.0);
    CHECK(odd.median == 3.0);
    CHECK(odd.max == 10.0);
    CHECK(spread_of({4.0, 1.0, 2.0, 10.0}).median == 3.0);
    CHECK(spread_of({5.0}).median == 5.0);
}

TEST_CASE("the table shows every phase and the rebuild share, each spread over its own frames",
          "[timing_table]") {
    const std::vector<FrameRecord> frames{record(10, 30), record(20, 20), record(3, 1)};
    const std::string table = timing_table(frames);
    CHECK(row(table, "rebuild") == Row{"3.00", "10.00", "20.00"});
    CHECK(row(table, "trace") == Row{"1.00", "20.00", "30.00"});
    CHECK(row(table, "animate") == Row{"1.00", "1.00", "1.00"});
    CHECK(row(table, "shade") == Row{"4.00", "4.00", "4.00"});
    CHECK(row(table, "write") == Row{"20.00", "20.00", "20.00"});
    CHECK(row(table, "total") == Row{"120.00", "120.00", "120.00"});
    // 10/40, 20/40, 3/4.
    CHECK(row(table, "rebuild share") == Row{"25.0%", "50.0%", "75.0%"});
}

TEST_CASE("failed frames have no times", "[timing_table]") {
    FrameRecord failed = record(1000, 1000);
    failed.error = "no";
    CHECK(timing_table(std::vector<FrameRecord>{failed}).empty());
    CHECK(row(timing_table(std::vector<FrameRecord>{failed, record(1, 1)}), "rebuild") ==
          Row{"1.00", "1.00", "1.00"});
    CHECK(rebuild_share(FrameRecord{}) == 0.0);
}

TEST_CASE("the table shows lambda where it was chosen", "[timing_table]") {
    std::vector<FrameRecord> frames{record(10, 30), record(20, 20), record(3, 1)};
    for (FrameRecord& frame : frames) frame.render.rebuild.lambda = 2.0f;
    CHECK(row(timing_table(frames), "lambda").empty());
    for (FrameRecord& frame : frames) frame.render.predicted = gridreel::traversal::GridCost{};
    frames[1].render.rebuild.lambda = 0.125f;
    CHECK(row(timing_table(frames), "lambda") == Row{"0.125", "2", "2"});
}
