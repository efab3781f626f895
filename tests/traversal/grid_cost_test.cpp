#include "traversal/grid_cost.h"

#include <catch2/catch.hpp>

#include <limits>
#include <vector>

namespace gridreel::traversal {
namespace {

/// Something like a frame of the suite; `lambda` moves what depends on the grid.
GridWork work_with(double lambda) {
    return {.triangles = 80e3,
            .cells = 80e3 * lambda,
            .references = 80e3 * (1.0 + 2.0 * lambda),
            .rays = 1e6,
            .visits = 300e3 * lambda,
            .tests = 5e6};
}

GridCost times(double factor, const GridCost& cost) {
    return {.rebuild_ms = factor * cost.rebuild_ms, .trace_ms = factor * cost.trace_ms};
}

}  // namespace

TEST_CASE("a visit meets as many references as there are in a cell", "[lambda]") {
    const GridWork work{.cells = 100.0, .references = 300.0, .visits = 20.0};
    CHECK(work.meetings() == Approx(60.0));
    CHECK(GridWork{.references = 300.0, .visits = 20.0}.meetings() == 0.0);
}

TEST_CASE("no work costs nothing, and more work more", "[lambda]") {
    const GridCostModel model;
    CHECK(model.cost({}).frame_ms() == 0.0);
    CHECK(model.cost(work_with(2.0)).rebuild_ms > model.cost(work_with(1.0)).rebuild_ms);
    CHECK(model.cost(work_with(2.0)).trace_ms > model.cost(work_with(1.0)).trace_ms);
}

TEST_CASE("one frame tells how fast the machine is, phase by phase", "[lambda]") {
    const GridCost built_in = GridCostModel().cost(work_with(1.0));
    const std::vector<MeasuredFrame> frames{
        {.work = work_with(1.0),
         .cost = {.rebuild_ms = 3.0 * built_in.rebuild_ms, .trace_ms = 0.25 * built_in.trace_ms}}};
    const GridCost elsewhere = GridCostModel().cost(work_with(4.0));
    const GridCost fitted = GridCostModel(frames).cost(work_with(4.0));
    CHECK(fitted.rebuild_ms == Approx(3.0 * elsewhere.rebuild_ms));
    CHECK(fitted.trace_ms == Approx(0.25 * elsewhere.trace_ms));
}

TEST_CASE("constants follow the measurements of many frames", "[lambda]") {
    // Visits cost nothing on this machine, and tests twice the time.
    std::vector<MeasuredFrame> frames;
    for (int i = 0; i < 24; ++i) {
        const double lambda = i % 2 == 0 ? 0.25 : 8.0;
        GridWork traced = work_with(lambda);
        traced.visits = 0.0;
        traced.tests *= 2.0;
        frames.push_back({.work = work_with(lambda), .cost = GridCostModel().cost(traced)});
    }
    const GridCostModel model(frames);
    for (const double lambda : {0.25, 8.0}) {
        const double measured = frames[lambda < 1.0 ? 0 : 1].cost.trace_ms;
        CHECK(model.cost(work_with(lambda)).trace_ms == Approx(measured).epsilon(0.05));
    }
}

TEST_CASE("a frame that something slowed down does not change much", "[lambda]") {
    const GridCost usual = GridCostModel().cost(work_with(1.0));
    std::vector<MeasuredFrame> frames(8, {.work = work_with(1.0), .cost = usual});
    frames.push_back({.work = work_with(1.0), .cost = times(1000.0, usual)});
    CHECK(GridCostModel(frames).cost(work_with(1.0)).frame_ms() == Approx(usual.frame_ms()).epsilon(0.01));
}

TEST_CASE("predictions stay finite and not negative whatever was measured", "[lambda]") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<MeasuredFrame> frames;
    for (const double ms : {nan, infinity, -infinity, -1.0, 0.0, 1e-300, 1e300}) {
        for (const GridWork& work : {GridWork{}, work_with(1.0), work_with(infinity), work_with(nan)}) {
            frames.push_back({.work = work, .cost = {.rebuild_ms = ms, .trace_ms = ms}});
        }
    }
    for (std::size_t count = 0; count <= frames.size(); ++count) {
        const GridCost cost = GridCostModel(std::span(frames).first(count)).cost(work_with(1.0));
        CHECK(cost.rebuild_ms >= 0.0);
        CHECK(cost.trace_ms >= 0.0);
        CHECK(cost.frame_ms() < infinity);
    }
}

}  // namespace gridreel::traversal
