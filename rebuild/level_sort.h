#pragma once
// Triangles into the cells of many grids at once, by a parallel counting sort.

#include "rebuild/cell_mapping.h"
#include "rebuild/grid.h"
#include "rebuild/known_lists.h"
#include "rebuild/reference_kernel.h"
#include "rebuild/triangle_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gridreel::rebuild {

/// One grid to fill.
struct GridJob {
    TriangleList triangles;             ///< to find
    std::optional<KnownLists> known{};  ///< of all other triangles
    bool nested = false;                ///< and not the top grid
    std::uint64_t reference_limit = 0;
    std::uint64_t references = 0;  ///< counted; above the limit, some number above it
    bool dropped = false;          ///< leave its cells empty

    [[nodiscard]] bool over_limit() const { return references > reference_limit; }
};

/// A cell with more than both is crowded.
struct Crowd {
    std::uint32_t references = 0;
    double times_mean = 0.0;  ///< as many as cells of its grid that are not empty have on average
};

/// A cell with so many references that it becomes a grid.
struct CrowdedCell {
    std::uint32_t grid = 0;  ///< of its level
    std::size_t cell = 0;    ///< of its level
};

/// Fills the grids of one level: `count`, then `scan` and `scatter`. Large grids are cut into chunks of
/// triangles, each with a histogram of its own; small ones are one chunk. Keeps its memory.
///
/// Each chunk writes down its references as it finds them, since finding them again would cost more than
/// reading them, and how many a triangle has is not to be guessed by a branch.
///
/// Chunks hold ascending triangles and own ascending slots of each cell, so the lists come out the same for
/// any number of threads. Known lists are taken over before their memory is written again, counted
/// behind what the last chunk found, and merged with it.
class LevelSort {
public:
    /// References per triangle that there is room for at first, and how many times what was needed there is
    /// once that was not enough.
    static constexpr double first_room = 2.5, spare_room = 1.1;
    static constexpr std::size_t chunk_limit = 16;               ///< private histograms cost chunks * cells
    static constexpr std::size_t triangles_per_chunk = 1 << 13;  ///< fewer are not worth a histogram

    /// Finds and counts the references of every job.
    /// @param level  its `grids` have bounds and resolutions, one per job; gets `first_cell`s. Its lists are
    ///               left as they are, for jobs that know some of them.
    void count(const TriangleView& triangles, std::span<GridJob> jobs, GridLevel& level);

    /// Turns counts into places.
    /// @return false, and nothing done, if there are more references than 32 bits can number
    [[nodiscard]] bool scan(std::span<const GridJob> jobs, GridLevel& level);

    /// Writes the lists of all jobs but the dropped ones. After `scan`, once.
    void scatter(std::span<const GridJob> jobs, GridLevel& level);

    /// The crowded cells of the level scattered last, ascending.
    void find_crowded(const GridLevel& level, const Crowd& least, std::vector<CrowdedCell>& crowded);

    [[nodiscard]] std::size_t bytes() const {
        return cells_.bytes() + triangles_.bytes() + histograms_.bytes();
    }
    /// Of those, what levels since `begin_frame` needed.
    [[nodiscard]] std::size_t used_bytes() const {
        return cells_.used_bytes() + triangles_.used_bytes() + histograms_.used_bytes();
    }
    void begin_frame() {
        cells_.begin_frame();
        triangles_.begin_frame();
        histograms_.begin_frame();
    }
    /// Lets all memory go.
    void release() { *this = {}; }

private:
    /// Some of a job's triangles, and the histogram they are counted in.
    struct Chunk {
        std::uint32_t job = 0;
        std::size_t begin = 0, end = 0;
        std::size_t histogram = 0;
        std::size_t first_reference = 0;
        std::size_t first_triangle = 0;
        std::size_t capacity = 0;      ///< references there is room for
        std::uint64_t references = 0;  ///< found
    };
    /// Some cells of a job's grid.
    struct Piece {
        std::uint32_t job = 0;
        std::size_t begin = 0, end = 0;
        std::uint64_t references = 0;
        std::uint32_t first_slot = 0;
        std::uint64_t occupied = 0;   ///< cells
        std::size_t crowded = 0;      ///< cells, then how many in pieces before it
        std::size_t first_known = 0;  ///< of what is taken over
    };
    struct Layout {
        std::size_t first_histogram = 0;
        std::size_t chunks = 0;
        std::size_t histograms = 0;  ///< one for each chunk; without any, one for known lists
        std::size_t cells = 0;
        std::uint64_t references = 0;
        std::uint64_t occupied = 0;       ///< cells
        std::uint64_t crowded_above = 0;  ///< references
    };
    void lay_out(std::span<const GridJob> jobs, GridLevel& level);
    void find(const TriangleView& triangles, const GridJob& job, const UniformGrid& grid, Chunk& chunk);
    void take_over(const KnownLists& known, const GridLevel& level, Piece& piece);
    void merge(const Piece& piece, GridLevel& level);
    /// In parallel, every piece of a job that knows some of its lists.
    template <class Visit>
    void for_each_known(std::span<const GridJob> jobs, const Visit& visit);
    [[nodiscard]] bool make_room(std::span<const GridJob> jobs);
    void find_limits(const Crowd& least);
    [[nodiscard]] double& room_per_triangle(const GridJob& job);
    [[nodiscard]] ReferenceRoom room_of(const Chunk& chunk);
    /// Known lists are counted with the last chunk's references, and lie behind them: once those are
    /// scattered, it says where.
    [[nodiscard]] std::uint32_t* last_histogram(const Layout& layout) {
        return histograms_.data() + layout.first_histogram + (layout.histograms - 1) * layout.cells;
    }

    /// References that chunks have room for, in the top grid and in nested ones. Grows on demand.
    std::array<double, 2> room_per_triangle_{first_room, first_room};
    std::vector<Layout> layouts_;  ///< one per job
    std::vector<Chunk> chunks_;
    std::vector<Piece> pieces_;
    bool any_known_ = false;
    Buffer<std::uint32_t> cells_;       ///< of each chunk's references, in the order of its triangles
    Buffer<std::uint32_t> triangles_;   ///< whose they are
    Buffer<std::uint32_t> histograms_;  ///< of each chunk, one count per cell of its grid
};

}  // namespace gridreel::rebuild
