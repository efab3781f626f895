#pragma once
// Closest hits that a ray cannot see through.

#include "engine/posed_scene.h"
#include "engine/see_through.h"
#include "rebuild/buffer.h"
#include "traversal/tracer.h"

#include <cstdint>

namespace gridreel::engine {

/// What tracing cost: operations, and wall clock inside the tracer.
struct TraceCost {
    traversal::TraceReport report;
    double ms = 0.0;

    TraceCost& operator+=(const TraceCost& other);
};

/// Traces batches again and again behind whatever they see through until every ray has hit something opaque
/// or nothing. Keeps its memory from batch to batch.
class OpaqueHits {
public:
    /// As `Tracer::closest_hits`. Rays that go on are traced as a smaller batch, from the same origins in the
    /// same order, behind the triangle they saw through.
    TraceCost closest(traversal::Tracer& tracer, const traversal::RayBatch& rays, const PosedScene& scene,
                      RayKind kind, traversal::HitBatch& hits);

private:
    rebuild::Buffer<std::uint8_t> goes_on_;
    rebuild::Buffer<std::uint32_t> chosen_;  ///< into the batch traced last
    rebuild::Buffer<std::uint32_t> ray_of_;  ///< into `rays`, one per ray of `rest_`
    rebuild::Buffer<std::uint32_t> next_ray_of_;
    traversal::RayBatch rest_;
    traversal::HitBatch rest_hits_;
};

}  // namespace gridreel::engine
