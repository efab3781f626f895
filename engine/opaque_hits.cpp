#include "engine/opaque_hits.h"

#include "engine/compact.h"
#include "engine/stopwatch.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace gridreel::engine {
namespace {

/// Fewer rays than this share of the batch are no neighbours any more: as packets they would see the whole
/// scene, so each goes alone, with its own origin.
constexpr std::size_t sparse_share = 64;

TraceCost timed_closest(traversal::Tracer& tracer, const traversal::RayBatch& rays,
                        traversal::HitBatch& hits) {
    const Stopwatch watch;
    const traversal::TraceReport report = tracer.closest_hits(rays, hits);
    return {.report = report, .ms = watch.ms()};
}

bool goes_on(const PosedScene& scene, std::uint32_t triangle, const Ray& ray, RayKind kind) {
    return triangle != traversal::no_triangle && !stops_at(scene, triangle, ray, kind);
}

}  // namespace

TraceCost& TraceCost::operator+=(const TraceCost& other) {
    report += other.report;
    ms += other.ms;
    return *this;
}

TraceCost OpaqueHits::closest(traversal::Tracer& tracer, const traversal::RayBatch& rays,
                              const PosedScene& scene, RayKind kind, traversal::HitBatch& hits) {
    TraceCost cost = timed_closest(tracer, rays, hits);

    // The first layer: every ray stands for itself.
    goes_on_.resize(rays.size());
    tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
        const Ray ray{.origin = rays.origin_of(i), .direction = rays.direction_of(i)};
        goes_on_[i] = goes_on(scene, hits.triangle[i], ray, kind);
    });
    compact(goes_on_, ray_of_);

    while (!ray_of_.empty()) {
        // Trace the rays that go on.
        const bool sparse = ray_of_.size() < rays.size() / sparse_share;
        const bool parallel = !sparse && rays.common_direction;
        if (parallel) {
            rest_.resize_parallel(ray_of_.size(), *rays.common_direction, rays.order);
        } else {
            rest_.resize(ray_of_.size(), sparse ? std::nullopt : rays.common_origin, rays.order);
        }
        rest_.after_triangle.resize(ray_of_.size());
        tbb::parallel_for(std::size_t{0}, ray_of_.size(), [&](std::size_t i) {
            const std::size_t ray = ray_of_[i];
            if (!rest_.common_origin) rest_.set_origin(i, rays.origin_of(ray));
            if (!parallel) rest_.set_direction(i, rays.direction_of(ray));
            rest_.t_min[i] = rays.t_min[ray];
            rest_.t_max[i] = rays.t_max[ray];
            rest_.after_triangle[i] = hits.triangle[ray];
        });
        cost += timed_closest(tracer, rest_, rest_hits_);

        // Keep what they hit, and see who goes on once more.
        goes_on_.resize(ray_of_.size());
        tbb::parallel_for(std::size_t{0}, ray_of_.size(), [&](std::size_t i) {
            const std::size_t ray = ray_of_[i];
            hits.t[ray] = rest_hits_.t[i];
            hits.triangle[ray] = rest_hits_.triangle[i];
            const Ray path{.origin = rays.origin_of(ray), .direction = rays.direction_of(ray)};
            goes_on_[i] = goes_on(scene, hits.triangle[ray], path, kind);
        });
        compact(goes_on_, chosen_);
        next_ray_of_.resize(chosen_.size());
        tbb::parallel_for(std::size_t{0}, chosen_.size(),
                          [&](std::size_t i) { next_ray_of_[i] = ray_of_[chosen_[i]]; });
        std::swap(ray_of_, next_ray_of_);
    }
    return cost;
}

}  // namespace gridreel::engine
