#include "traversal/grid_tracer.h"

#include "traversal/packet_kernel.h"
#include "traversal/single_ray_kernel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace gridreel::traversal {
namespace {

using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t rays_per_task = 1024;  // one by one
constexpr std::size_t packets_per_task = 4;

/// Runs `trace(begin, end)` over pieces of [0, count) in parallel. The reports are integers, so their sum
/// does not depend on the order.
template <class Trace>
TraceReport trace_in_parallel(std::size_t count, std::size_t grain, const Trace& trace) {
    return tbb::parallel_reduce(
        Range(0, count, grain), TraceReport{},
        [&](const Range& range, TraceReport report) { return report += trace(range.begin(), range.end()); },
        [](TraceReport a, const TraceReport& b) { return a += b; });
}

}  // namespace

GridTracer::GridTracer(const rebuild::ResolutionPolicy& resolution, Traversal traversal)
    : traversal_(traversal), builder_(resolution) {}

rebuild::BuildReport GridTracer::rebuild(const rebuild::TriangleView& triangles) {
    triangles_ = triangles;
    return builder_.rebuild(triangles);
}

/// @param packets     traces packets [begin, end) of a `PacketSource`
/// @param one_by_one  traces rays [begin, end)
template <class Packets, class OneByOne>
TraceReport GridTracer::trace(const RayBatch& rays, const Packets& packets, const OneByOne& one_by_one) {
    resumed_.begin(rays, triangles_);
    const GridScene scene{builder_.grid(), triangles_};
    if (in_packets(rays)) {
        const PacketSource source(rays, resumed_, sorted(rays));
        return trace_in_parallel(
            source.packet_count(), packets_per_task,
            [&](std::size_t begin, std::size_t end) { return packets(scene, source, begin, end); });
    }
    return trace_in_parallel(rays.size(), rays_per_task, [&](std::size_t begin, std::size_t end) {
        return one_by_one(scene, begin, end);
    });
}

TraceReport GridTracer::closest_hits(const RayBatch& rays, HitBatch& hits) {
    hits.resize(rays.size());
    return trace(
        rays,
        [&](const GridScene& scene, const PacketSource& source, std::size_t begin, std::size_t end) {
            return closest_in_packets(scene, source, begin, end, hits);
        },
        [&](const GridScene& scene, std::size_t begin, std::size_t end) {
            return closest_one_by_one(scene, rays, resumed_, begin, end, hits);
        });
}

TraceReport GridTracer::any_hits(const RayBatch& rays, OcclusionBatch& occluded) {
    occluded.resize(rays.size());
    return trace(
        rays,
        [&](const GridScene& scene, const PacketSource& source, std::size_t begin, std::size_t end) {
            return any_in_packets(scene, source, begin, end, occluded);
        },
        [&](const GridScene& scene, std::size_t begin, std::size_t end) {
            return any_one_by_one(scene, rays, resumed_, begin, end, occluded);
        });
}

bool GridTracer::in_packets(const RayBatch& rays) const {
    return traversal_ == Traversal::coherent && rays.common_origin.has_value();
}

const SortedRays* GridTracer::sorted(const RayBatch& rays) {
    return rays.order == RayOrder::coherent ? nullptr : &ray_sort_.sort(rays);
}

}  // namespace gridreel::traversal
