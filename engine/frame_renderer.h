#pragma once
// One frame: pose, deform, rebuild, trace and shade wave by wave, into a film.

#include "anim/clip.h"
#include "anim/scene.h"
#include "engine/film.h"
#include "engine/render_settings.h"
#include "rebuild/build_report.h"
#include "traversal/grid_cost.h"
#include "traversal/tracer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gridreel::engine {

/// What one frame cost. Milliseconds are wall clock.
struct FrameReport {
    double animate_ms = 0.0;  ///< pose and deform
    rebuild::BuildReport rebuild;
    double trace_ms = 0.0;  ///< making rays, sorting, marching, intersecting: primary and shadow rays
    double primary_ms = 0.0;
    double shadow_ms = 0.0;
    double shade_ms = 0.0;  ///< the rest of making pixels
    std::size_t moving_triangles = 0;
    std::size_t still_triangles = 0;
    traversal::TraceReport primary;
    traversal::TraceReport shadow;
    std::optional<traversal::GridCost> predicted;  ///< where λ was chosen by cost: what it should have cost
};

/// Renders frames of one clip. Frames are independent: any time may follow any other, and a frame's
/// pixels depend only on scene, clip, settings and time, never on the thread count or earlier frames. Those
/// before it may tell how many cells its grid is to have (`traversal::LambdaChooser`).
class FrameRenderer {
public:
    /// Decodes textures and chooses camera and lights.
    /// @param scene  outlives the renderer
    /// @throws Error when the camera does not exist
    FrameRenderer(const anim::Scene& scene, anim::Clip clip, const RenderSettings& settings);
    ~FrameRenderer();

    /// Renders the frame at `time_s` into `film` (resized).
    FrameReport render(double time_s, Film& film);

    [[nodiscard]] std::int32_t width() const;
    [[nodiscard]] std::int32_t height() const;

    /// What the renderer decided on its own or could not honour ("no light in the file: …"), a sentence each.
    [[nodiscard]] const std::vector<std::string>& notes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace gridreel::engine
