#pragma once
// A run of pixels, wave by wave: camera rays, what they hit, one batch of shadow rays per light, the film.

#include "engine/camera.h"
#include "engine/film.h"
#include "engine/lights.h"
#include "engine/opaque_hits.h"
#include "engine/pixel_order.h"
#include "engine/posed_scene.h"
#include "engine/sample_pattern.h"
#include "engine/surface.h"
#include "rebuild/buffer.h"
#include "traversal/tracer.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <span>

namespace gridreel::engine {

/// What all bands of a frame share.
struct Frame {
    const PosedScene& scene;
    const View& view;
    const Lighting& lighting;
    const SamplePattern& pattern;
    traversal::Tracer& tracer;   ///< rebuilt for `scene`
    glm::vec4 background{0.0f};  ///< linear RGB, not premultiplied, and alpha
    float exposure = 1.0f;       ///< factor on R, G, B
    bool cut_outs = false;       ///< some material lets shadow rays through
};

struct BandReport {
    traversal::TraceReport primary, shadow;
    double primary_ms = 0.0;  ///< making camera rays and tracing them
    double shadow_ms = 0.0;   ///< making shadow rays and tracing them
};

/// The memory of one band, reused by the next. Every sample's light is summed light by light, every pixel's
/// sample by sample: a fixed order for any number of threads.
class Band {
public:
    /// Renders `pixels`, a run of `pixel_order`, into `film`.
    BandReport render(const Frame& frame, std::span<const Pixel> pixels, Film& film);

private:
    void find_surfaces(const Frame& frame);
    void add_light(const Frame& frame, const PosedLight& light, BandReport& report);
    void choose_lit(const PosedLight& light);
    void make_shadow_rays(const PosedLight& light);
    void find_shadowed(const Frame& frame, BandReport& report);
    void resolve(const Frame& frame, std::span<const Pixel> pixels, Film& film) const;

    // One entry per camera ray: pixel after pixel, the samples of a pixel side by side.
    traversal::RayBatch camera_rays_;
    traversal::HitBatch hits_;
    rebuild::Buffer<Surface> surfaces_;    ///< unspecified where nothing was hit
    rebuild::Buffer<glm::vec3> radiance_;  ///< of what was hit

    // One entry per camera ray whose surface the light may reach.
    rebuild::Buffer<std::uint8_t> lit_;
    rebuild::Buffer<std::uint32_t> sample_of_;
    traversal::RayBatch shadow_rays_;
    traversal::HitBatch shadow_hits_;
    traversal::OcclusionBatch occluded_;

    OpaqueHits opaque_hits_;
};

}  // namespace gridreel::engine
