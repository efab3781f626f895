#pragma once
// One frame: pose, deform, rebuild, trace and shade wave by wave, into a film.

#include "anim/clip.h"
#include "anim/scene.h"
#include "engine/film.h"
#include "rebuild/build_report.h"
#include "traversal/tracer.h"

#include <glm/vec4.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gridreel::engine {

enum class LightChoice {
    automatic,  ///< the file's lights, or the default ones when it has none
    file,       ///< the file's lights only, even if there are none
    standard,   ///< the default dome and key light only
};

struct RenderSettings {
    std::int32_t width = 1280;                 ///< pixels, >= 1
    std::optional<std::int32_t> height = 720;  ///< pixels, >= 1; absent: from `width` and the camera's aspect
    std::int32_t samples = 4;                  ///< per pixel, >= 1
    std::uint32_t seed = 0;                    ///< of the sample pattern
    std::string camera = "auto";               ///< "auto", "fit", a camera node's name, or its number from 0
    LightChoice lights = LightChoice::automatic;
    glm::vec4 background{0.18f, 0.18f, 0.18f, 1.0f};  ///< linear RGB, not premultiplied, and alpha
    float exposure_stops = 0.0f;                      ///< pictures are multiplied by 2^exposure_stops
    traversal::TracerOptions tracer;
    std::size_t rays_per_band = 2'000'000;  ///< memory bound: a frame with more goes in horizontal bands
};

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
};

/// Renders frames of one clip. Frames are independent: any time may follow any other, and a frame's
/// pixels depend only on scene, clip, settings and time, never on the thread count or earlier frames.
class FrameRenderer {
public:
    /// Decodes textures and chooses camera and lights.
    /// @param scene  outlives the renderer
    /// @throws Error when the camera does not exist, or a texture cannot be decoded
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
