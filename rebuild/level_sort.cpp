#include "rebuild/level_sort.h"

#include <hwy/cache_control.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace gridreel::rebuild {
namespace {

constexpr std::size_t cells_per_piece = 1 << 13;
/// Known lists take longer than prefix sums.
constexpr std::size_t cells_per_known_piece = 1 << 10;
constexpr std::size_t prefetch_distance = 16;  // references; about what waiting for a cache costs

/// The k-th of `parts` equal parts of `count` things begins here.
std::size_t part_begin(std::size_t count, std::size_t k, std::size_t parts) {
    return count * k / parts;
}

}  // namespace

void LevelSort::lay_out(std::span<const GridJob> jobs, GridLevel& level) {
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    layouts_.resize(jobs.size());
    chunks_.clear();
    pieces_.clear();
    std::size_t cells = 0, references = 0, histograms = 0, all_triangles = 0;
    for (std::size_t j = 0; j < jobs.size(); ++j) {
        UniformGrid& grid = level.grids[j];
        const std::size_t triangles = jobs[j].triangles.count;
        Layout& layout = layouts_[j];
        layout = {.first_histogram = histograms, .cells = grid.cell_count()};
        if (triangles > 0) {
            layout.chunks =
                std::clamp<std::size_t>(triangles / triangles_per_chunk, 1, std::min(threads, chunk_limit));
        }
        layout.histograms = std::max<std::size_t>(layout.chunks, jobs[j].known ? 1 : 0);
        const auto job = static_cast<std::uint32_t>(j);
        for (std::size_t k = 0; k < layout.chunks; ++k) {
            Chunk chunk{.job = job,
                        .begin = part_begin(triangles, k, layout.chunks),
                        .end = part_begin(triangles, k + 1, layout.chunks),
                        .histogram = histograms + k * grid.cell_count(),
                        .first_reference = references,
                        .first_triangle = all_triangles + part_begin(triangles, k, layout.chunks)};
            const double room = room_per_triangle(jobs[j]) * double(chunk.end - chunk.begin);
            chunk.capacity = std::min<std::size_t>(jobs[j].reference_limit, static_cast<std::size_t>(room));
            chunks_.push_back(chunk);
            references += chunk.capacity + ReferenceRoom::padding;
        }
        histograms += layout.histograms * grid.cell_count();
        all_triangles += triangles;
        grid.first_cell = cells;
        const std::size_t per_piece = jobs[j].known ? cells_per_known_piece : cells_per_piece;
        const std::size_t pieces = (grid.cell_count() + per_piece - 1) / per_piece;
        for (std::size_t k = 0; k < pieces; ++k) {
            pieces_.push_back({.job = job,
                               .begin = part_begin(grid.cell_count(), k, pieces),
                               .end = part_begin(grid.cell_count(), k + 1, pieces),
                               .first_known = references});
            if (!jobs[j].known) continue;
            const std::uint32_t* const begins = level.cell_begin.data() + jobs[j].known->first_cell;
            references += begins[pieces_.back().end] - begins[pieces_.back().begin];
        }
        cells += grid.cell_count();
    }
    cells_.resize(references);
    triangles_.resize(all_triangles);
    histograms_.resize(histograms);
    any_known_ = std::any_of(jobs.begin(), jobs.end(), [](const GridJob& job) { return job.known; });
}

double& LevelSort::room_per_triangle(const GridJob& job) {
    return room_per_triangle_[job.nested ? 1 : 0];
}

ReferenceRoom LevelSort::room_of(const Chunk& chunk) {
    return {.cells = cells_.data() + chunk.first_reference,
            .triangles = triangles_.data() + chunk.first_triangle,
            .capacity = chunk.capacity};
}

/// Writes down the references of a chunk and counts them, cell by cell.
void LevelSort::find(const TriangleView& triangles, const GridJob& job, const UniformGrid& grid,
                     Chunk& chunk) {
    const ReferenceRoom room = room_of(chunk);
    chunk.references = find_references(triangles, job.triangles, chunk.begin, chunk.end,
                                       CellMapping(grid.bounds, grid.resolution, grid.least_slack), room,
                                       job.reference_limit);
    if (chunk.references > room.capacity) return;
    std::uint32_t* const histogram = histograms_.data() + chunk.histogram;
    std::fill_n(histogram, grid.cell_count(), 0u);
    for (std::size_t k = 0; k < chunk.references; ++k) ++histogram[room.cells[k] & ~next_triangle];
}

/// Copies a piece of known lists and counts them.
void LevelSort::take_over(const KnownLists& known, const GridLevel& level, Piece& piece) {
    const Layout& layout = layouts_[piece.job];
    std::uint32_t* const histogram = last_histogram(layout);
    if (layout.chunks == 0) std::fill(histogram + piece.begin, histogram + piece.end, 0u);
    piece.references =
        copy_known(known, level, piece.begin, piece.end, cells_.data() + piece.first_known, histogram);
}

/// Puts a piece of known lists among what was found.
void LevelSort::merge(const Piece& piece, GridLevel& level) {
    const Layout& layout = layouts_[piece.job];
    const std::uint32_t* const begins = level.cell_begin.data() + level.grids[piece.job].first_cell;
    const std::uint32_t* const known = cells_.data() + piece.first_known;
    std::uint32_t* const references = level.references.data();
    if (layout.chunks == 0) {
        std::copy_n(known, begins[piece.end] - begins[piece.begin], references + begins[piece.begin]);
    } else {
        merge_known(known, piece.begin, piece.end, begins, last_histogram(layout), references);
    }
}

/// @return false if some chunk found more references than it had room for: now there will be
bool LevelSort::make_room(std::span<const GridJob> jobs) {
    bool enough = true;
    for (const Chunk& chunk : chunks_) {
        if (chunk.references <= chunk.capacity || jobs[chunk.job].over_limit()) continue;
        double& room = room_per_triangle(jobs[chunk.job]);
        room = std::max(room, spare_room * double(chunk.references) / double(chunk.end - chunk.begin));
        enough = false;
    }
    return enough;
}

template <class Visit>
void LevelSort::for_each_known(std::span<const GridJob> jobs, const Visit& visit) {
    if (!any_known_) return;
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t k) {
        if (jobs[pieces_[k].job].known) visit(pieces_[k]);
    });
}

void LevelSort::count(const TriangleView& triangles, std::span<GridJob> jobs, GridLevel& level) {
    do {
        lay_out(jobs, level);
        tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t k) {
            const std::uint32_t job = chunks_[k].job;
            find(triangles, jobs[job], level.grids[job], chunks_[k]);
        });
        for_each_known(jobs, [&](Piece& piece) { take_over(*jobs[piece.job].known, level, piece); });
        for (GridJob& job : jobs) job.references = 0;
        for (const Chunk& chunk : chunks_) jobs[chunk.job].references += chunk.references;
        for (const Piece& piece : pieces_) jobs[piece.job].references += piece.references;
    } while (!make_room(jobs));
}

bool LevelSort::scan(std::span<const GridJob> jobs, GridLevel& level) {
    // How many references each piece holds, over all histograms of its grid.
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t k) {
        Piece& piece = pieces_[k];
        piece.references = 0;
        if (jobs[piece.job].dropped) return;
        const std::size_t cells = level.grids[piece.job].cell_count();
        const Layout& layout = layouts_[piece.job];
        for (std::size_t h = 0; h < layout.histograms; ++h) {
            const std::uint32_t* histogram = histograms_.data() + layout.first_histogram + h * cells;
            for (std::size_t c = piece.begin; c < piece.end; ++c) piece.references += histogram[c];
        }
    });
    std::uint64_t total = 0;
    for (Piece& piece : pieces_) {
        piece.first_slot = static_cast<std::uint32_t>(total);
        total += piece.references;
    }
    if (total > std::numeric_limits<std::uint32_t>::max()) return false;

    // cell_begin[c], and in each histogram the first slot of its chunk in cell c.
    const UniformGrid& last = level.grids[level.grids.size() - 1];
    level.cell_begin.resize(last.first_cell + last.cell_count() + 1);
    // Whoever reads whole registers also does at lists that are empty, be they all.
    if (total == 0) level.references.resize(1);
    level.references.resize(total);
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t k) {
        Piece& piece = pieces_[k];
        std::uint32_t* const begins = level.cell_begin.data() + level.grids[piece.job].first_cell;
        std::uint32_t next = piece.first_slot;
        piece.occupied = 0;
        if (jobs[piece.job].dropped) {
            std::fill(begins + piece.begin, begins + piece.end, next);
            return;
        }
        const std::size_t cells = level.grids[piece.job].cell_count();
        const Layout& layout = layouts_[piece.job];
        std::uint32_t* const histograms = histograms_.data() + layout.first_histogram;
        for (std::size_t c = piece.begin; c < piece.end; ++c) {
            begins[c] = next;
            for (std::size_t h = 0; h < layout.histograms; ++h) {
                next += std::exchange(histograms[h * cells + c], next);
            }
            piece.occupied += next != begins[c];
        }
    });
    level.cell_begin[level.cell_begin.size() - 1] = static_cast<std::uint32_t>(total);
    return true;
}

void LevelSort::scatter(std::span<const GridJob> jobs, GridLevel& level) {
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t k) {
        const Chunk& chunk = chunks_[k];
        const GridJob& job = jobs[chunk.job];
        if (job.dropped) return;
        const ReferenceRoom found = room_of(chunk);
        std::uint32_t* const next = histograms_.data() + chunk.histogram;
        std::uint32_t* const references = level.references.data();
        const std::uint32_t* triangle = found.triangles;
        const auto place = [&](std::size_t i) {
            triangle += (found.cells[i] & next_triangle) != 0;
            references[next[found.cells[i] & ~next_triangle]++] = triangle[-1];
        };
        const std::size_t count = chunk.references;
        const std::size_t prefetched = count - std::min(prefetch_distance, count);
        for (std::size_t i = 0; i < prefetched; ++i) {
            hwy::Prefetch(references + next[found.cells[i + prefetch_distance] & ~next_triangle]);
            place(i);
        }
        for (std::size_t i = prefetched; i < count; ++i) place(i);
    });
    for_each_known(jobs, [&](const Piece& piece) { merge(piece, level); });
}

/// From how many references on a cell of each grid is crowded.
void LevelSort::find_limits(const Crowd& least) {
    for (Layout& layout : layouts_) layout.references = layout.occupied = 0;
    for (const Piece& piece : pieces_) {
        layouts_[piece.job].references += piece.references;
        layouts_[piece.job].occupied += piece.occupied;
    }
    for (Layout& layout : layouts_) {
        const double mean = double(layout.references) / double(std::max<std::uint64_t>(1, layout.occupied));
        layout.crowded_above =
            std::max<std::uint64_t>(least.references, static_cast<std::uint64_t>(least.times_mean * mean));
    }
}

void LevelSort::find_crowded(const GridLevel& level, const Crowd& least, std::vector<CrowdedCell>& crowded) {
    find_limits(least);
    const auto visit = [&](const Piece& piece, const auto& found) {
        const std::size_t first = level.grids[piece.job].first_cell;
        const std::uint64_t limit = layouts_[piece.job].crowded_above;
        for (std::size_t c = first + piece.begin; c < first + piece.end; ++c) {
            const std::uint32_t size = level.cell_begin[c + 1] - level.cell_begin[c];
            if (size > limit) found(c);
        }
    };
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t k) {
        pieces_[k].crowded = 0;
        if (pieces_[k].references <= layouts_[pieces_[k].job].crowded_above) return;
        visit(pieces_[k], [&](std::size_t) { ++pieces_[k].crowded; });
    });
    std::size_t total = 0;
    for (Piece& piece : pieces_) total += std::exchange(piece.crowded, total);
    crowded.resize(total);
    if (total == 0) return;
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t k) {
        if (pieces_[k].references <= layouts_[pieces_[k].job].crowded_above) return;
        std::size_t next = pieces_[k].crowded;
        visit(pieces_[k], [&](std::size_t c) { crowded[next++] = {.grid = pieces_[k].job, .cell = c}; });
    });
}

}  // namespace gridreel::rebuild
