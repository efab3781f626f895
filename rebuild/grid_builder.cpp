#include "rebuild/grid_builder.h"

#include "rebuild/grid_shape.h"
#include "rebuild/reference_kernel.h"

#include <glm/geometric.hpp>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

namespace gridreel::rebuild {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t references_per_triangle_limit = 64;

/// So many frames in a row must need less than half of the memory before it is let go.
constexpr int oversized_limit = 8;

/// Cells are numbered in 32 bits.
constexpr std::int64_t most_cells = std::int64_t{1} << 31;

/// A nested grid that needs more is not worth its memory: its triangles lie across each other, and finer
/// cells would not part them. A mere surface needs references in proportion to its area in cells:
/// lambda^(2/3).
double nested_references_per_triangle_limit(float lambda) {
    return 4.0 * std::pow(std::max(1.0, double(lambda)), 2.0 / 3.0);
}

/// Nesting is for cells more crowded than the rest, like teapots in stadiums. Where all cells that are not
/// empty hold many triangles, as those of a surface of millions do, more cells would help: that is lambda's
/// business. A coarse grid is asked for where nested grids do better than a finer one, so it nests more
/// readily. Fitted on the suite: with less, sheets nest; with more, teapots stay crowded cells.
double crowded_times_mean(float lambda) {
    return 16.0 * std::pow(std::min(1.0, double(lambda)), 1.5);
}

/// Of the whole scene: the rounding of corners as seen from some diagonals away, so that rays from there find
/// them in their cells, however small the cells of nested grids are.
constexpr double slack_per_diagonal = 0x1p-22;

/// Milliseconds since the last call.
class PhaseTimer {
public:
    double lap() {
        const auto now = Clock::now();
        const std::chrono::duration<double, std::milli> elapsed = now - std::exchange(last_, now);
        return elapsed.count();
    }

private:
    Clock::time_point last_ = Clock::now();
};

TriangleList list_of(std::span<const std::uint32_t> triangles) {
    return {.indices = triangles.data(), .count = triangles.size()};
}

}  // namespace

GridBuilder::GridBuilder(const ResolutionPolicy& policy) : policy_(policy) {
    (void)choose_resolution({}, 0, policy);  // throws on a bad policy now, not frames later
    policy_.max_cells = std::min(policy.max_cells, most_cells);
}

void GridBuilder::set_lambda(float lambda) {
    ResolutionPolicy policy = policy_;
    policy.lambda = lambda;
    (void)choose_resolution({}, 0, policy);
    policy_ = policy;
}

BuildReport GridBuilder::rebuild(const TriangleView& triangles) {
    if (triangles.size() >= nested_mark) throw std::length_error("2^31 triangles or more in one grid");
    PhaseTimer whole;
    PhaseTimer timer;
    BuildReport report;
    report.lambda = policy_.lambda;
    if (oversized_ == oversized_limit) release();
    if (policy_.heed_still) last_frame_.begin(triangles, policy_.lambda, grid_);
    sort_.begin_frame();
    for (GridLevel& level : grid_.levels) level.begin_frame();

    const Bounds3 box = measure(triangles);
    if (box.empty()) return report;
    report.bounds_ms = timer.lap();
    build_top(triangles, box, report);

    PhaseTimer nesting;
    for (std::size_t depth = 1; depth <= deepest_nesting && nest(triangles, depth, report); ++depth) {
    }
    report.nesting_ms = nesting.lap();
    last_frame_.end();

    report.total_ms = whole.lap();
    report.resolution = grid_.top().resolution;
    report.bytes = bytes();
    oversized_ = report.bytes > 2 * used_bytes() ? oversized_ + 1 : 0;
    return report;
}

/// The box of all triangles. That of still ones is found once.
Bounds3 GridBuilder::measure(const TriangleView& triangles) {
    const StillTriangles* const still = last_frame_.still();
    if (still == nullptr || !still->few_move()) {
        return traceable_bounds(triangles, {.count = triangles.size()});
    }
    std::optional<Bounds3>& still_box = last_frame_.still_box;
    if (!still_box) {
        still_box.emplace();
        for (const TriangleRun& run : still->runs()) {
            still_box->extend(bounds_of(triangles, {.count = run.end}, run.begin, run.end));
        }
    }
    Bounds3 box = traceable_bounds(triangles, list_of(still->few_moving()));
    box.extend(*still_box);
    return box;
}

/// @param known  whose lists are those of the last frame
GridJob GridBuilder::top_job(std::size_t triangles, const StillTriangles* known) const {
    GridJob job{.triangles = {.count = triangles},
                .reference_limit = references_per_triangle_limit * triangles};
    if (known != nullptr && known->few_move()) {
        job.triangles = list_of(known->few_moving());
        job.known = KnownLists{.first_cell = 0, .only = known};
    }
    return job;
}

void GridBuilder::build_top(const TriangleView& triangles, const Bounds3& box, BuildReport& report) {
    PhaseTimer timer;
    GridLevel& level = grid_.levels[0];
    level.grids.resize(1);
    UniformGrid& grid = level.grids[0];
    jobs_.resize(1);
    GridJob& job = jobs_[0];

    // Too many references mean too many cells. 64 for each of 2^31 triangles could exceed 32 bits, too.
    ResolutionPolicy policy = policy_;
    const double least_slack = slack_per_diagonal * glm::length(glm::dvec3{box.extent()});
    for (;;) {
        grid = grid_in(box, triangles.size(), policy, least_slack);
        job = top_job(triangles.size(), last_frame_.compare_top(grid) ? last_frame_.still() : nullptr);
        sort_.count(triangles, jobs_, level);
        report.count_ms += timer.lap();
        if ((!job.over_limit() || grid.cell_count() == 1) && sort_.scan(jobs_, level)) break;
        policy.lambda /= 3.0f;
    }
    report.scan_ms = timer.lap();
    sort_.scatter(jobs_, level);
    report.scatter_ms = timer.lap();
    report.cells = grid.cell_count();
    report.references = level.references.size();
}

/// Makes grids of the crowded cells of the level above.
/// @return whether there are any
bool GridBuilder::nest(const TriangleView& triangles, std::size_t depth, BuildReport& report) {
    if (policy_.nest_above == 0) return false;
    sort_.find_crowded(grid_.levels[depth - 1],
                       {.references = policy_.nest_above, .times_mean = crowded_times_mean(policy_.lambda)},
                       crowded_);
    if (crowded_.empty()) return false;

    GridLevel& level = grid_.levels[depth];
    measure_nested(triangles, depth);
    sort_.count(triangles, jobs_, level);
    for (GridJob& job : jobs_) job.dropped = job.dropped || job.over_limit();
    if (!sort_.scan(jobs_, level)) {
        level.clear();
        last_frame_.nested(depth).resize(0);
        return false;
    }
    sort_.scatter(jobs_, level);
    mark_nested(depth);
    for (std::size_t j = 0; j < jobs_.size(); ++j) {
        if (jobs_[j].dropped) continue;
        ++report.nested_grids;
        report.cells += level.grids[j].cell_count();
    }
    report.references += level.references.size();
    return true;
}

/// Jobs and grids for the crowded cells: tight boxes and resolutions.
void GridBuilder::measure_nested(const TriangleView& triangles, std::size_t depth) {
    const GridLevel& above = grid_.levels[depth - 1];
    GridLevel& level = grid_.levels[depth];
    level.grids.resize(crowded_.size());
    jobs_.resize(crowded_.size());
    if (last_frame_.still() != nullptr) last_frame_.nested(depth).resize(crowded_.size());
    const double limit = nested_references_per_triangle_limit(policy_.lambda);
    tbb::parallel_for(std::size_t{0}, crowded_.size(), [&](std::size_t i) {
        const CrowdedCell& place = crowded_[i];
        const std::uint32_t begin = above.cell_begin[place.cell];
        const TriangleList list{.indices = above.references.data() + begin,
                                .count = above.cell_begin[place.cell + 1] - begin};
        jobs_[i] = {.triangles = list,
                    .nested = true,
                    .reference_limit = static_cast<std::uint64_t>(limit * double(list.count))};
        if (last_frame_.still() != nullptr && take_over(depth, i, list)) return;
        const UniformGrid& parent = above.grids[place.grid];
        level.grids[i] = nested_grid(triangles, parent, place.cell - parent.first_cell, list);
    });
}

/// The grid of a crowded cell.
UniformGrid GridBuilder::nested_grid(const TriangleView& triangles, const UniformGrid& parent,
                                     std::size_t cell_of_parent, const TriangleList& list) const {
    const Bounds3 cell = box_of_cell(parent, cell_of_parent);
    Bounds3 box = traceable_bounds(triangles, list);
    box = {.min = glm::max(box.min, cell.min), .max = glm::min(box.max, cell.max)};
    // From far away corners stand beside their places, by more than the padding of a small box.
    if (!box.empty()) {
        box.min -= static_cast<float>(parent.least_slack);
        box.max += static_cast<float>(parent.least_slack);
    }
    return grid_in(box.empty() ? cell : box, list.count, policy_, parent.least_slack);
}

/// Remembers a nested grid's place, and takes the grid over from the last frame if it is the same.
/// @return whether it is
bool GridBuilder::take_over(std::size_t depth, std::size_t index, const TriangleList& list) {
    const CrowdedCell& place = crowded_[index];
    const UniformGrid& parent = grid_.levels[depth - 1].grids[place.grid];
    NestedGrid& next = last_frame_.nested(depth)[index];
    next = {.parent = place.grid, .cell = static_cast<std::uint32_t>(place.cell - parent.first_cell)};
    next.still = depth > 1
                     ? last_frame_.nested(depth - 1)[place.grid].still
                     : std::all_of(list.indices, list.indices + list.count, [&](std::uint32_t triangle) {
                           return last_frame_.still()->is_still(triangle);
                       });
    next.was = last_frame_.same_as(depth, next);
    if (!next.was) return false;

    const NestedGrid& same = last_frame_.last(depth, *next.was);
    GridJob& job = jobs_[index];
    job.triangles = {};
    job.dropped = same.dropped;
    const UniformGrid& grid = last_frame_.last_grid(depth, *next.was);
    if (!same.dropped) job.known = KnownLists{.first_cell = grid.first_cell};
    grid_.levels[depth].grids[index] = grid;
    return true;
}

/// Puts the grids of a level in the place of the cells they were made of.
void GridBuilder::mark_nested(std::size_t depth) {
    GridLevel& above = grid_.levels[depth - 1];
    Buffer<NestedGrid>& remembered = last_frame_.nested(depth);
    tbb::parallel_for(std::size_t{0}, crowded_.size(), [&](std::size_t i) {
        const std::size_t cell = crowded_[i].cell;
        std::uint32_t* const first = above.references.data() + above.cell_begin[cell];
        if (last_frame_.still() != nullptr) {
            remembered[i].dropped = jobs_[i].dropped;
            std::copy_n(first, 2, remembered[i].displaced);
        }
        if (jobs_[i].dropped) return;
        first[0] = nested_mark | static_cast<std::uint32_t>(i);
        first[1] = above.cell_begin[cell + 1] - above.cell_begin[cell];
    });
}

void GridBuilder::release() {
    grid_ = {};
    sort_.release();
    last_frame_.forget();
    oversized_ = 0;
}

std::size_t GridBuilder::used_bytes() const {
    std::size_t sum = sort_.used_bytes() + last_frame_.used_bytes();
    for (const GridLevel& level : grid_.levels) sum += level.used_bytes();
    return sum;
}

std::size_t GridBuilder::bytes() const {
    std::size_t sum = sort_.bytes() + last_frame_.bytes();
    for (const GridLevel& level : grid_.levels) sum += level.bytes();
    return sum;
}

}  // namespace gridreel::rebuild
