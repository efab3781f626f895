#include "traversal/grid_cost.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace gridreel::traversal {
namespace {

/// Milliseconds of a phase, by what they are for.
template <std::size_t Count>
using Terms = std::array<double, Count>;

/// How far off the built-in constants may be, each for itself, and how far off times are at least: shares,
/// squared.
constexpr double variance_of_constants = 0.6 * 0.6, least_variance_of_times = 0.15 * 0.15;

// Nanoseconds, least squares over the suite at λ from 1/16 to 16 on one thread. Only how they compare with
// each other matters after the first frame.

Terms<3> rebuild_terms(const GridWork& work) {
    return {14.5e-6 * work.triangles, 0.5e-6 * work.cells, 9.5e-6 * work.references};
}

Terms<4> trace_terms(const GridWork& work) {
    return {10.5e-6 * work.rays, 4.8e-6 * work.visits, 2.2e-6 * work.meetings(), 2.3e-6 * work.tests};
}

template <std::size_t Count>
double sum(const Terms<Count>& terms) {
    return std::accumulate(terms.begin(), terms.end(), 0.0);
}

template <std::size_t Count>
double dot(const Terms<Count>& a, const Terms<Count>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// One phase of the frames measured.
template <std::size_t Count>
class PhaseFit {
public:
    void add(Terms<Count> terms, double ms) {
        const double predicted = sum(terms);
        if (!std::isfinite(ms) || ms <= 0.0 || !std::isfinite(predicted) || predicted <= 0.0) return;
        for (double& term : terms) term /= ms;
        rows_.push_back(terms);
    }

    [[nodiscard]] Terms<Count> factors() const {
        Terms<Count> factors;
        factors.fill(1.0);
        if (rows_.empty()) return factors;
        const double slowness = median_slowness();
        factors.fill(slowness);
        // Once to learn how noisy times are: the noisier, the less they say about constants.
        fit(factors, slowness, least_variance_of_times);
        fit(factors, slowness, std::max(least_variance_of_times, variance_about(factors)));
        return factors;
    }

private:
    /// How many times longer than the built-in constants say.
    [[nodiscard]] double median_slowness() const {
        std::vector<double> values;
        for (const Terms<Count>& row : rows_) values.push_back(1.0 / sum(row));
        return median(std::move(values));
    }

    [[nodiscard]] double variance_about(const Terms<Count>& factors) const {
        double squares = 0.0;
        for (const Terms<Count>& row : rows_) squares += std::pow(1.0 - dot(row, factors), 2.0);
        return squares / double(rows_.size());
    }

    /// Least squares of 1 - predicted / measured, so that no frame, however slow, is more than 1 off, with a
    /// pull towards the built-in constants times `slowness` (ridge regression), by coordinate descent.
    void fit(Terms<Count>& factors, double slowness, double variance) const {
        constexpr int rounds = 64;  // far more than it takes to settle
        const double ridge = variance / (variance_of_constants * slowness * slowness);
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t i = 0; i < Count; ++i) {
                double pull = ridge * slowness, weight = ridge;
                for (const Terms<Count>& row : rows_) {
                    pull += row[i] * (1.0 - dot(row, factors) + row[i] * factors[i]);
                    weight += row[i] * row[i];
                }
                factors[i] = std::max(0.0, pull / weight);
            }
        }
    }

    std::vector<Terms<Count>> rows_;  ///< terms as shares of the time measured
};

}  // namespace

GridCostModel::GridCostModel(std::span<const MeasuredFrame> frames) {
    PhaseFit<3> rebuild;
    PhaseFit<4> trace;
    for (const MeasuredFrame& frame : frames) {
        rebuild.add(rebuild_terms(frame.work), frame.cost.rebuild_ms);
        trace.add(trace_terms(frame.work), frame.cost.trace_ms);
    }
    rebuild_ = rebuild.factors();
    trace_ = trace.factors();
}

GridCost GridCostModel::cost(const GridWork& work) const {
    return {.rebuild_ms = dot(rebuild_, rebuild_terms(work)), .trace_ms = dot(trace_, trace_terms(work))};
}

}  // namespace gridreel::traversal
