#pragma once
// What rebuilding and tracing a grid costs, predicted from what there is to do.

#include <array>
#include <span>

namespace gridreel::traversal {

/// One frame's work. Doubles, because predicted work is no whole number.
struct GridWork {
    double triangles = 0.0;
    double cells = 0.0;       ///< of all grids
    double references = 0.0;  ///< of all grids
    double rays = 0.0;
    double visits = 0.0;  ///< cells looked into, by packets or single rays
    double tests = 0.0;   ///< ray-triangle intersections computed

    /// References met on the way: as many a visit as there are a cell.
    [[nodiscard]] double meetings() const { return cells > 0.0 ? visits * references / cells : 0.0; }
};

struct GridCost {
    double rebuild_ms = 0.0;
    double trace_ms = 0.0;

    [[nodiscard]] double frame_ms() const { return rebuild_ms + trace_ms; }
};

/// A frame's work and what it took.
struct MeasuredFrame {
    GridWork work;
    GridCost cost;
};

/// Linear in the work (Aronov, Bronnimann, Chang & Chiang 2006, "Cost prediction for ray shooting in
/// octrees": the cells a ray visits and the objects it meets in them; all cells of a uniform grid being
/// alike, their sum over cells comes down to the mean number of references), and in what does not depend on
/// the grid:
///
///     rebuild_ms = a triangles + b cells + c references
///     trace_ms   = d rays + e visits + f meetings + g tests
class GridCostModel {
public:
    /// The constants built in: what one machine took for the scenes of `tools/bench-suite`.
    GridCostModel() = default;

    /// Constants fitted to what was measured: not negative, and as near to those built in, times the
    /// machine's speed, as the measurements leave open. Frames that something else slowed down have little
    /// weight. Of frames without a phase's work, or with a time that is not finite and above 0, nothing is
    /// learned of that phase.
    explicit GridCostModel(std::span<const MeasuredFrame> frames);

    [[nodiscard]] GridCost cost(const GridWork& work) const;

private:
    // Factors of the built-in constants.
    std::array<double, 3> rebuild_{1.0, 1.0, 1.0};
    std::array<double, 4> trace_{1.0, 1.0, 1.0, 1.0};
};

}  // namespace gridreel::traversal
