#include "traversal/lambda_chooser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace gridreel::traversal {
namespace {

constexpr std::size_t frames_remembered = 12;  ///< of each λ
constexpr std::size_t longest_trust = 128;     ///< frames for which a λ left behind counts as known
constexpr std::size_t farthest_guess = 2;      ///< rungs

constexpr double worth_a_change = 0.97;     ///< of the current λ's cost
constexpr double hope = 0.8;                ///< of the predicted cost, for a λ that is not known
constexpr double largest_correction = 1.2;  ///< either way: more is noise rather than the model's fault

/// A frame of which only triangles and camera rays are known, at λ = 1: the middle of the suite.
GridWork typical_work(double triangles, double camera_rays) {
    const double rays = 1.7 * camera_rays;
    return {.triangles = triangles,
            .cells = 1.2 * triangles,
            .references = 3.6 * triangles,
            .rays = rays,
            .visits = 0.3 * rays,
            .tests = 6.0 * rays};
}

/// The same frame's work with `growth` times as many cells per triangle.
///
/// A triangle of a cells' length is listed in about (1 + a)^2 of them, and a grows with λ^(1/3). Single rays
/// visit λ^(1/3) times as many cells, packets more, since they are wider than cells: on the suite λ^(1/2).
GridWork extrapolated(GridWork work, double growth) {
    const double per_triangle = work.triangles > 0.0 ? work.references / work.triangles : 0.0;
    const double size = std::sqrt(std::max(1.0, per_triangle)) - 1.0;
    const double listed = (1.0 + size * std::cbrt(growth)) / (1.0 + size);
    work.cells *= growth;
    work.references *= listed * listed;
    work.visits *= std::sqrt(growth);
    return work;
}

GridWork with_triangles(GridWork work, double triangles) {
    if (work.triangles <= 0.0) return work;
    const double scale = triangles / work.triangles;
    work.triangles *= scale;
    work.cells *= scale;
    work.references *= scale;
    return work;
}

bool is_sound(const GridWork& work) {
    const std::array counts{work.triangles, work.cells, work.references, work.rays, work.visits, work.tests};
    return work.triangles > 0.0 && std::all_of(counts.begin(), counts.end(), [](double count) {
               return std::isfinite(count) && count >= 0.0;
           });
}

bool is_sound(const GridCost& cost) {
    return std::isfinite(cost.frame_ms()) && cost.rebuild_ms >= 0.0 && cost.trace_ms >= 0.0 &&
           cost.frame_ms() > 0.0;
}

/// 1 of nothing.
double median(std::vector<double> values) {
    if (values.empty()) return 1.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

}  // namespace

LambdaChooser::LambdaChooser(std::uint64_t camera_rays) : camera_rays_(camera_rays) {
    correction_.fill(1.0);
}

LambdaChoice LambdaChooser::choose(std::size_t triangles) const {
    // What each λ would cost, unknown ones a little less.
    std::array<double, rungs> ms{};
    for (std::size_t rung = 0; rung < rungs; ++rung) {
        const bool guessed = current_ && !known_[rung];
        const std::optional<GridWork> work = work_at(rung, double(triangles));
        ms[rung] = work ? (guessed ? hope : 1.0) * cost_at(rung, *work).frame_ms()
                        : std::numeric_limits<double>::infinity();
    }

    const auto best = static_cast<std::size_t>(std::min_element(ms.begin(), ms.end()) - ms.begin());
    const bool stays = current_ && !(ms[best] < worth_a_change * ms[*current_]);
    const std::size_t rung = stays ? *current_ : best;
    return {.lambda = ladder[rung], .predicted = cost_at(rung, *work_at(rung, double(triangles)))};
}

void LambdaChooser::measured(float lambda, const MeasuredFrame& frame) {
    const auto step = std::find(ladder.begin(), ladder.end(), lambda);
    if (step == ladder.end() || !is_sound(frame.work)) return;
    const auto rung = static_cast<std::size_t>(step - ladder.begin());

    for (std::size_t other = 0; other < rungs; ++other) {
        if (!known_[other] || ++known_[other]->age <= longest_trust) continue;
        known_[other].reset();
        past_[other].clear();
    }
    if (current_ == rung && known_[rung]) carry_along(known_[rung]->work, frame.work);
    known_[rung] = {.work = frame.work, .age = 0};
    current_ = rung;

    if (!is_sound(frame.cost)) return;
    std::deque<MeasuredFrame>& past = past_[rung];
    past.push_back(frame);
    if (past.size() > frames_remembered) past.pop_front();
    learn();
}

/// What changed between two frames of the same λ would have changed with any other.
void LambdaChooser::carry_along(const GridWork& before, const GridWork& now) {
    const auto carry = [](double& count, double from, double to) {
        if (from > 0.0 && to > 0.0) count *= to / from;
    };
    for (std::optional<Known>& known : known_) {
        if (!known) continue;
        carry(known->work.triangles, before.triangles, now.triangles);
        carry(known->work.cells, before.cells, now.cells);
        carry(known->work.references, before.references, now.references);
        carry(known->work.rays, before.rays, now.rays);
        carry(known->work.visits, before.visits, now.visits);
        carry(known->work.tests, before.tests, now.tests);
    }
}

void LambdaChooser::learn() {
    std::vector<MeasuredFrame> frames;
    for (const auto& past : past_) frames.insert(frames.end(), past.begin(), past.end());
    model_ = GridCostModel(frames);

    // Against the usual ratio, which is above 1 where times are noisy: the model heeds the quick frames more.
    std::array<std::vector<double>, rungs> ratios;
    std::vector<double> all;
    for (std::size_t rung = 0; rung < rungs; ++rung) {
        for (const MeasuredFrame& frame : past_[rung]) {
            const double predicted = model_.cost(frame.work).frame_ms();
            if (predicted > 0.0) ratios[rung].push_back(frame.cost.frame_ms() / predicted);
        }
        all.insert(all.end(), ratios[rung].begin(), ratios[rung].end());
    }
    const double usual = median(std::move(all));
    for (std::size_t rung = 0; rung < rungs; ++rung) {
        // One frame says half of what it seems to, and a few nearly all.
        const auto frames_seen = double(ratios[rung].size());
        const double trust = frames_seen / (frames_seen + 1.0);
        const double seen = std::pow(median(std::move(ratios[rung])) / usual, trust);
        correction_[rung] = std::clamp(seen, 1.0 / largest_correction, largest_correction);
    }
}

/// As known; else the cheapest that any λ known nearby makes it look; nothing where there is none.
std::optional<GridWork> LambdaChooser::work_at(std::size_t rung, double triangles) const {
    if (!current_) {
        return extrapolated(typical_work(triangles, double(camera_rays_)), double(ladder[rung]));
    }
    if (known_[rung]) return with_triangles(known_[rung]->work, triangles);

    std::optional<GridWork> cheapest;
    double least_ms = std::numeric_limits<double>::infinity();
    for (std::size_t from = 0; from < rungs; ++from) {
        const std::size_t distance = from < rung ? rung - from : from - rung;
        if (!known_[from] || distance > farthest_guess) continue;
        const double growth = double(ladder[rung]) / double(ladder[from]);
        const GridWork work = extrapolated(with_triangles(known_[from]->work, triangles), growth);
        const double ms = model_.cost(work).frame_ms();
        if (ms >= least_ms) continue;
        least_ms = ms;
        cheapest = work;
    }
    return cheapest;
}

GridCost LambdaChooser::cost_at(std::size_t rung, const GridWork& work) const {
    const GridCost cost = model_.cost(work);
    return {.rebuild_ms = correction_[rung] * cost.rebuild_ms, .trace_ms = correction_[rung] * cost.trace_ms};
}

std::optional<LambdaChooser> make_lambda_chooser(const TracerOptions& options, std::uint64_t camera_rays) {
    const bool is_grid = options.kind == TracerKind::grid || options.kind == TracerKind::grid_single;
    if (!is_grid || options.lambda == LambdaRule::fixed) return std::nullopt;
    return LambdaChooser(camera_rays);
}

MeasuredFrame measured_frame(std::size_t triangles, const rebuild::BuildReport& built,
                             const TraceReport& traced, double trace_ms) {
    return {.work = {.triangles = double(triangles),
                     .cells = double(built.cells),
                     .references = double(built.references),
                     .rays = double(traced.rays),
                     .visits = double(traced.cells),
                     .tests = double(traced.triangle_tests)},
            .cost = {.rebuild_ms = built.total_ms, .trace_ms = trace_ms}};
}

}  // namespace gridreel::traversal
