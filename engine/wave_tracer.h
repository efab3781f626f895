#pragma once
// Frames traced for what tracing costs: the rays of a picture, and no picture.

#include "anim/clip.h"
#include "anim/scene.h"
#include "engine/opaque_hits.h"
#include "engine/render_settings.h"
#include "rebuild/build_report.h"
#include "traversal/tracer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gridreel::engine {

/// Whether to trace, after camera and shadow rays, one diffuse ray from every point that the camera sees.
enum class Bounce { left_out, traced };

/// What the waves of one frame cost. Only time inside the tracer counts as tracing.
struct WaveReport {
    TraceCost primary;
    /// One for each way of the tracer (`Tracer::ways`): the same rays, traced once in each.
    std::vector<TraceCost> shadow, bounce;
    double making_ms = 0.0;  ///< making rays, and finding the surfaces that they start from
};

/// Poses frames of a clip and traces their rays by any tracer: the camera rays and the shadow rays that a
/// `FrameRenderer` would trace if every surface were opaque and seen from both sides, wave by wave, band by
/// band. Neither reads textures nor shades.
class WaveTracer {
public:
    /// @param scene  outlives the tracer
    /// @throws Error when the camera does not exist
    WaveTracer(const anim::Scene& scene, anim::Clip clip, const RenderSettings& settings);
    ~WaveTracer();

    /// Poses and deforms. @return milliseconds
    double animate(double time_s);

    /// From the triangles last posed.
    rebuild::BuildReport rebuild(traversal::Tracer& tracer) const;

    /// @param tracer  rebuilt since `animate`
    WaveReport trace(traversal::Tracer& tracer, Bounce bounce);

    [[nodiscard]] std::size_t moving_triangles() const;
    [[nodiscard]] std::size_t still_triangles() const;

    /// Of each frame.
    [[nodiscard]] std::size_t camera_ray_count() const;

    /// As `FrameRenderer::notes`, but for looks.
    [[nodiscard]] const std::vector<std::string>& notes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace gridreel::engine
