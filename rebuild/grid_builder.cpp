#include "rebuild/grid_builder.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <limits>
#include <span>
#include <utility>

namespace gridreel::rebuild {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t references_per_triangle_limit = 64;
constexpr std::size_t chunk_limit = 16;  // private histograms cost chunks * cells
constexpr std::size_t scan_pieces = 64;

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

/// The k-th of `pieces` equal parts of `count` things.
struct Piece {
    std::size_t begin, end;
    Piece(std::size_t count, std::size_t k, std::size_t pieces)
        : begin(count * k / pieces), end(count * (k + 1) / pieces) {}
};

/// The box of all triangles that can be hit. Vertices that no triangle uses do not stretch it.
Bounds3 traceable_bounds(const TriangleView& view) {
    constexpr std::size_t grain = 1 << 13;
    using Range = tbb::blocked_range<std::size_t>;
    // Minimum and maximum do not depend on the order in which parts are joined.
    return tbb::parallel_reduce(
        Range(0, view.size(), grain), Bounds3{},
        [&](const Range& range, Bounds3 box) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const glm::uvec3& corners = view.triangles[i];
                const glm::vec3& a = view.positions[corners.x];
                const glm::vec3& b = view.positions[corners.y];
                const glm::vec3& c = view.positions[corners.z];
                if (!is_traceable(a) || !is_traceable(b) || !is_traceable(c)) continue;
                box.extend({.min = glm::min(a, glm::min(b, c)), .max = glm::max(a, glm::max(b, c))});
            }
            return box;
        },
        [](Bounds3 a, const Bounds3& b) {
            a.extend(b);
            return a;
        });
}

/// A box with some thickness on every axis, so that cells have a size.
Bounds3 padded(const Bounds3& box) {
    const glm::vec3 extent = box.extent();
    const float largest = std::max({extent.x, extent.y, extent.z});
    const glm::vec3 size = glm::max(glm::abs(box.min), glm::abs(box.max));
    // At least an ulp or two of the coordinates, or the padding would round away far from the origin.
    const glm::vec3 pad = glm::max(glm::vec3{1e-5f * largest}, glm::max(size * 4e-7f, glm::vec3{1e-30f}));
    return {.min = box.min - pad, .max = box.max + pad};
}

}  // namespace

GridBuilder::GridBuilder(const ResolutionPolicy& policy) : policy_(policy) {
    (void)choose_resolution({}, 0, policy);  // throws on a bad policy now, not frames later
}

BuildReport GridBuilder::rebuild(const TriangleView& triangles) {
    const auto start = Clock::now();
    PhaseTimer timer;
    BuildReport report;

    // Box and resolution.
    const Bounds3 box = traceable_bounds(triangles);
    if (box.empty()) {
        grid_.bounds = {};
        grid_.resolution = glm::ivec3{0};
        grid_.cell_begin.resize(0);
        grid_.references.resize(0);
        return report;
    }
    grid_.bounds = padded(box);
    ResolutionPolicy policy = policy_;
    grid_.resolution = choose_resolution(grid_.bounds, triangles.size(), policy);
    report.bounds_ms = timer.lap();

    // Count; too many references mean too many cells.
    ranges_.resize(triangles.size());
    histograms_.resize(std::clamp<std::size_t>(
        static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()), 1, chunk_limit));
    for (;;) {
        const CellMapping mapping(grid_.bounds, grid_.resolution);
        grid_.cell_size = mapping.cell_size();
        grid_.slack = mapping.slack();
        if (count(triangles, mapping) || grid_.cell_count() == 1) break;
        policy.lambda /= 3.0f;
        grid_.resolution = choose_resolution(grid_.bounds, triangles.size(), policy);
    }
    report.count_ms = timer.lap();

    scan();
    report.scan_ms = timer.lap();
    scatter();
    report.scatter_ms = timer.lap();

    const std::chrono::duration<double, std::milli> total = Clock::now() - start;
    report.total_ms = total.count();
    report.resolution = grid_.resolution;
    report.cells = grid_.cell_count();
    report.references = grid_.references.size();
    report.bytes = bytes();
    return report;
}

/// Each chunk of triangles fills its own histogram.
/// @return false when there are too many references; a decision that does not depend on the number of chunks
bool GridBuilder::count(const TriangleView& triangles, const CellMapping& mapping) {
    const std::size_t chunks = histograms_.size();
    const std::uint64_t limit = references_per_triangle_limit * triangles.size();
    std::atomic<std::uint64_t> total{0};
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        Buffer<std::uint32_t>& histogram = histograms_[chunk];
        histogram.resize(grid_.cell_count());
        std::fill(histogram.begin(), histogram.end(), 0u);
        std::uint64_t references = 0;
        const Piece piece(triangles.size(), chunk, chunks);
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            const glm::uvec3& corners = triangles.triangles[i];
            const CellRange range =
                mapping.cells_of(triangles.positions[corners.x], triangles.positions[corners.y],
                                 triangles.positions[corners.z]);
            ranges_[i] = range;
            references += range.cell_count();
            if (references > limit) break;
            for_each_cell(range, grid_.resolution, [&](std::size_t cell) { ++histogram[cell]; });
        }
        total += references;
    });
    // 64 references a triangle of at most 2^32 triangles could exceed the 32 bits of `cell_begin`.
    return total <= std::min<std::uint64_t>(limit, std::numeric_limits<std::uint32_t>::max());
}

/// Turns counts into places: cell_begin[c], and in each histogram the first slot of its chunk in cell c.
void GridBuilder::scan() {
    const std::size_t cells = grid_.cell_count();
    grid_.cell_begin.resize(cells + 1);

    std::array<std::uint32_t, scan_pieces + 1> piece_begin{};
    tbb::parallel_for(std::size_t{0}, scan_pieces, [&](std::size_t k) {
        const Piece piece(cells, k, scan_pieces);
        std::uint32_t sum = 0;
        for (const auto& histogram : histograms_) {
            for (std::size_t cell = piece.begin; cell < piece.end; ++cell) sum += histogram[cell];
        }
        piece_begin[k + 1] = sum;
    });
    for (std::size_t k = 0; k < scan_pieces; ++k) piece_begin[k + 1] += piece_begin[k];

    tbb::parallel_for(std::size_t{0}, scan_pieces, [&](std::size_t k) {
        const Piece piece(cells, k, scan_pieces);
        std::uint32_t next = piece_begin[k];
        for (std::size_t cell = piece.begin; cell < piece.end; ++cell) {
            grid_.cell_begin[cell] = next;
            for (auto& histogram : histograms_) next += std::exchange(histogram[cell], next);
        }
    });
    grid_.cell_begin[cells] = piece_begin[scan_pieces];
    grid_.references.resize(piece_begin[scan_pieces]);
}

/// Chunks hold ascending triangles and own ascending slots of each cell, so lists come out ascending.
void GridBuilder::scatter() {
    const std::size_t chunks = histograms_.size();
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        std::uint32_t* next = histograms_[chunk].data();
        std::uint32_t* references = grid_.references.data();
        const Piece piece(ranges_.size(), chunk, chunks);
        for (std::size_t i = piece.begin; i < piece.end; ++i) {
            const auto triangle = static_cast<std::uint32_t>(i);
            for_each_cell(ranges_[i], grid_.resolution,
                          [&](std::size_t cell) { references[next[cell]++] = triangle; });
        }
    });
}

std::size_t GridBuilder::bytes() const {
    std::size_t sum = grid_.cell_begin.bytes() + grid_.references.bytes() + ranges_.bytes();
    for (const auto& histogram : histograms_) sum += histogram.bytes();
    return sum;
}

}  // namespace gridreel::rebuild
