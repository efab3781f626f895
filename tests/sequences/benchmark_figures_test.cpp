#include "sequences/benchmark_figures.h"
#include "sequences/benchmark_json.h"
#include "sequences/benchmark_table.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace gridreel::sequences {
namespace {

using Catch::Matchers::Contains;

BenchmarkRun run(double rebuild_ms, double primary_ms, std::vector<double> shadow_ms) {
    BenchmarkRun result;
    result.rebuild.total_ms = rebuild_ms;
    result.rebuild.bytes = 1200;
    result.waves.primary = {.report = {.rays = 1000}, .ms = primary_ms};
    for (const double ms : shadow_ms) {
        result.waves.shadow.push_back({.report = {.rays = 500}, .ms = ms});
    }
    return result;
}

/// A grid with one way of tracing against a rival with two.
SceneBenchmark duel() {
    SceneBenchmark benchmark{.scene = "knot",
                             .frames = 1,
                             .moving_triangles = 90,
                             .still_triangles = 10,
                             .competitors = {},
                             .notes = {}};
    benchmark.competitors.push_back({.name = "grid",
                                     .threads = 2,
                                     .ways = {"the only one"},
                                     .runs = {run(1, 4, {5}), run(3, 2, {9}), run(2, 3, {7})}});
    benchmark.competitors.push_back(
        {.name = "embree",
         .threads = 2,
         .ways = {"packets", "single"},
         .runs = {run(6, 2, {30, 14}), run(8, 2, {10, 15}), run(4, 2, {20, 13})}});
    return benchmark;
}

const Ratio& ratio_of(const SceneFigures& figures, const std::string& phase) {
    for (const Ratio& ratio : figures.ratios) {
        if (ratio.phase == phase) return ratio;
    }
    FAIL("no ratio of " << phase);
    return figures.ratios.front();
}

}  // namespace

TEST_CASE("figures are medians, and ratios those of medians", "[sequences][benchmark]") {
    const SceneFigures figures = figures_of(duel());
    const CompetitorFigures& grid = figures.competitors.at(0);
    CHECK(grid.phase("rebuild")->median_ms == 2.0);
    CHECK(grid.phase("rebuild")->min_ms == 1.0);
    CHECK(grid.phase("rebuild")->p95_ms == 3.0);
    CHECK(grid.phase("shadow")->median_ms == 7.0);
    CHECK(grid.phase("shadow")->way.empty());
    // 1000 rays in 4, 2 and 3 ms.
    CHECK(grid.phase("primary")->rays_per_second == Approx(1000 / 3e-3));
    // 1+4+5, 3+2+9, 2+3+7.
    CHECK(grid.phase("frame")->ms == std::vector<double>{10, 14, 12});
    CHECK(grid.phase("frame")->median_ms == 12.0);
    CHECK(grid.rebuild_share == Approx(2.0 / 12.0));
    CHECK(grid.bytes_per_triangle == 12.0);
    CHECK(grid.phase("bounce") == nullptr);

    const Ratio& rebuild = ratio_of(figures, "rebuild");
    CHECK(rebuild.scene == "knot");
    CHECK(rebuild.against == "embree");
    CHECK(rebuild.threads == 2);
    CHECK(rebuild.ours_ms == 2.0);
    CHECK(rebuild.theirs_ms == 6.0);
    CHECK(rebuild.speedup == 3.0);
}

TEST_CASE("of several ways to trace, the one with the better median counts", "[sequences][benchmark]") {
    const SceneFigures figures = figures_of(duel());
    const PhaseFigures& shadow = *figures.competitors.at(1).phase("shadow");
    CHECK(shadow.way == "single");
    CHECK(shadow.ms == std::vector<double>{14, 15, 13});
    CHECK(shadow.median_ms == 14.0);
    CHECK(ratio_of(figures, "shadow").speedup == 2.0);
    // 6+2+14, 8+2+15, 4+2+13.
    CHECK(figures.competitors.at(1).phase("frame")->ms == std::vector<double>{22, 25, 19});
}

TEST_CASE("ratios keep to the same number of threads and leave out phases of no time",
          "[sequences][benchmark]") {
    SceneBenchmark benchmark = duel();
    benchmark.competitors.push_back(benchmark.competitors.at(1));
    benchmark.competitors.back().threads = 1;
    for (BenchmarkRun& nothing : benchmark.competitors.at(0).runs) nothing.waves.shadow.at(0) = {};
    const SceneFigures figures = figures_of(benchmark);
    for (const Ratio& ratio : figures.ratios) {
        CHECK(ratio.threads == 2);
        CHECK(ratio.phase != "shadow");
    }
    CHECK(figures.ratios.size() == 3);  // rebuild, primary, frame
}

TEST_CASE("the 95th percentile is a value that occurred", "[sequences][benchmark]") {
    SceneBenchmark benchmark = duel();
    benchmark.competitors.resize(1);
    benchmark.competitors.front().runs.clear();
    for (int i = 40; i >= 1; --i) benchmark.competitors.front().runs.push_back(run(i, 1, {1}));
    // 38 of the 40 runs take at most 38 ms.
    CHECK(figures_of(benchmark).competitors.front().phase("rebuild")->p95_ms == 38.0);
}

TEST_CASE("operations are counted per ray, over all runs", "[sequences][benchmark]") {
    SceneBenchmark benchmark = duel();
    auto& grid = benchmark.competitors.at(0).runs;
    grid.at(0).waves.primary.report = {.rays = 1000, .cells = 500, .triangle_tests = 4000};
    grid.at(1).waves.primary.report = {.rays = 1000, .cells = 700, .triangle_tests = 6000};
    grid.at(2).waves.primary.report = {.rays = 2000, .cells = 1600, .triangle_tests = 14'000};
    grid.at(2).waves.primary.report.extra_bytes =
        5 * (benchmark.moving_triangles + benchmark.still_triangles);
    // A rival's ways: those of the better one count.
    auto& rival = benchmark.competitors.at(1).runs;
    for (BenchmarkRun& each : rival) {
        each.waves.shadow.at(0).report.triangle_tests = 500;
        each.waves.shadow.at(1).report.triangle_tests = 1000;
    }
    const SceneFigures figures = figures_of(benchmark);
    const PhaseFigures& primary = *figures.competitors.at(0).phase("primary");
    CHECK(primary.cells_per_ray == Approx(2800.0 / 4000.0));
    CHECK(primary.tests_per_ray == Approx(24'000.0 / 4000.0));
    CHECK(figures.competitors.at(0).phase("shadow")->tests_per_ray == 0.0);
    CHECK(figures.competitors.at(1).phase("shadow")->tests_per_ray == 2.0);

    const std::string table = benchmark_table(figures);
    CHECK_THAT(
        table,
        Contains("of the frame, primary: 0.70 cells and 6.00 tests a ray, with 5.0 more bytes a triangle\n"));
    CHECK_THAT(table, Contains("shadow: 0.00 cells and 2.00 tests a ray, shadow rays: single"));
    const std::vector<SceneFigures> scenes{figures};
    const auto json = nlohmann::json::parse(benchmark_json(scenes, "AVX"));
    for (const auto& entry : json["benchmarks"]) {
        if (entry["name"] == "knot/grid/threads:2/primary") {
            CHECK(entry["cells_per_ray"] == primary.cells_per_ray);
            CHECK(entry["triangle_tests_per_ray"] == primary.tests_per_ray);
            CHECK(entry["extra_bytes_per_triangle"] == 5.0);
        } else {
            CHECK(entry.contains("triangle_tests_per_ray") ==
                  (entry["name"] == "knot/embree/threads:2/shadow"));
        }
    }
}

TEST_CASE("columns of the table stand below each other, however long a name is", "[sequences][benchmark]") {
    SceneBenchmark benchmark = duel();
    benchmark.competitors.at(1).name = "grid:packet=16,culling=off,mailbox=off,macrocells=off";
    const std::string table = benchmark_table(figures_of(benchmark));
    const auto end_of_line_with = [&](const std::string& text) {
        const std::size_t at = table.find(text);
        REQUIRE(at != std::string::npos);
        return table.find("  |", at) - table.rfind('\n', at);
    };
    CHECK(end_of_line_with("grid  ") == end_of_line_with("ms  "));
    CHECK(end_of_line_with("macrocells=off  ") == end_of_line_with("ms  "));
}

TEST_CASE("phases that were not measured have no figures", "[sequences][benchmark]") {
    SceneBenchmark benchmark = duel();
    benchmark.phase = BenchmarkPhase::rebuild;
    for (Competitor& competitor : benchmark.competitors) {
        for (BenchmarkRun& each : competitor.runs) each.waves = {};
    }
    const SceneFigures rebuilt = figures_of(benchmark);
    CHECK(rebuilt.competitors.front().phase("primary") == nullptr);
    CHECK(rebuilt.competitors.front().phase("frame") == nullptr);
    CHECK(rebuilt.ratios.size() == 1);

    benchmark = duel();
    benchmark.phase = BenchmarkPhase::trace;
    const SceneFigures traced = figures_of(benchmark);
    CHECK(traced.competitors.front().phase("rebuild") == nullptr);
    CHECK(traced.competitors.front().bytes_per_triangle == 12.0);
}

TEST_CASE("tables show the figures", "[sequences][benchmark]") {
    SceneFigures figures = figures_of(duel());
    const std::string table = benchmark_table(figures);
    CHECK_THAT(table, Contains("knot: 90 triangles moving, 10 still; 1 frame, 3 runs of each competitor"));
    CHECK_THAT(table, Contains("grid against embree, 2 threads: rebuild 3.00x primary 0.67x shadow 2.00x"));
    CHECK_THAT(table, Contains("shadow rays: single"));
    CHECK_THAT(table, Contains("grid, 2 threads: 12.0 bytes a triangle, rebuild 16.7% of the frame"));

    figures.scene = "a|b";
    const std::vector<SceneFigures> scenes{figures};
    CHECK(markdown_table(scenes) ==
          "| scene | triangles | threads | rebuild, embree | primary, embree | shadow, embree | frame, "
          "embree |\n"
          "|---|--:|--:|--:|--:|--:|--:|\n"
          "| a\\|b | 100 | 2 | 3.00 | 0.67 | 2.00 | 1.83 |\n");
}

}  // namespace gridreel::sequences
