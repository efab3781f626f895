#pragma once
// How many cells per triangle the next frame's grid gets: the λ with the lowest predicted cost.

#include "traversal/grid_cost.h"
#include "traversal/tracer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace gridreel::traversal {

/// λ of a frame, and what rebuilding and tracing with it should cost.
struct LambdaChoice {
    float lambda = 1.0f;
    GridCost predicted;
};

/// Minimises predicted rebuild + trace, frame by frame.
///
/// Every λ of a ladder is predicted by a `GridCostModel` of the last frames, from the work there was when
/// that λ was last used, carried along with what has changed since; where it was not used lately, from laws
/// of how work grows with λ. Work is counted, so it has no noise; where times at one λ are off the model
/// again and again, they correct its predictions. Another λ is taken when it promises 3 % less. One that is
/// not known is hoped to cost a fifth less than predicted: so each promising one is tried once, and then left
/// alone for 128 frames if it was not worth it.
///
/// A pure function of what it was told: the measurements of a log give the log's choices again.
class LambdaChooser {
public:
    /// What it chooses from.
    static constexpr std::array<float, 7> ladder{0.125f, 0.25f, 0.5f, 1.0f, 2.0f, 4.0f, 8.0f};

    /// @param camera_rays  of each frame, for a guess at the first one
    explicit LambdaChooser(std::uint64_t camera_rays);

    /// For the next frame. Without `measured` in between, the same again.
    [[nodiscard]] LambdaChoice choose(std::size_t triangles) const;

    /// What a frame with this λ took. A λ that is not on the ladder, and a frame without triangles, teach
    /// nothing; times that are not finite and above 0 only how much work there was.
    void measured(float lambda, const MeasuredFrame& frame);

private:
    static constexpr std::size_t rungs = ladder.size();

    struct Known {
        GridWork work;        ///< as it would be in the last frame
        std::size_t age = 0;  ///< frames since it was last used
    };

    void carry_along(const GridWork& before, const GridWork& now);
    void learn();
    [[nodiscard]] std::optional<GridWork> work_at(std::size_t rung, double triangles) const;
    [[nodiscard]] GridCost cost_at(std::size_t rung, const GridWork& work) const;

    std::uint64_t camera_rays_;
    std::array<std::optional<Known>, rungs> known_;
    std::optional<std::size_t> current_;  ///< rung of the last frame
    std::array<std::deque<MeasuredFrame>, rungs> past_;
    GridCostModel model_;
    std::array<double, rungs> correction_;
};

/// For tracers that need one: grids whose λ is chosen by cost.
/// @param camera_rays  as of `LambdaChooser`
[[nodiscard]] std::optional<LambdaChooser> make_lambda_chooser(const TracerOptions& options,
                                                               std::uint64_t camera_rays);

/// A frame for the chooser, from its reports.
/// @param traced  rays of all kinds together
[[nodiscard]] MeasuredFrame measured_frame(std::size_t triangles, const rebuild::BuildReport& built,
                                           const TraceReport& traced, double trace_ms);

}  // namespace gridreel::traversal
