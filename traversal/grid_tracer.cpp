#include "traversal/grid_tracer.h"

#include "traversal/loose_kernel.h"
#include "traversal/packet_kernel.h"
#include "traversal/single_ray_kernel.h"
#include "traversal/stream_kernel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/partitioner.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace gridreel::traversal {
namespace {

using Range = tbb::blocked_range<std::size_t>;

constexpr std::size_t rays_per_task = 4096;  // incoherent: at a task's end, few are left to go side by side
/// Rays in a task share a mailbox: so that reports are the same for any number of threads, tasks are, too.
const tbb::simple_partitioner always_the_same;
constexpr std::size_t packets_per_task = 4;
constexpr std::size_t hard_ray = 4;            // rays, when it comes to what is worth knowing of cells
constexpr std::size_t references_per_ray = 2;  // of more, what is known of them costs more than it saves

/// Runs `trace(begin, end)` over pieces of [0, count) in parallel. The reports are integers, so their sum
/// does not depend on the order.
template <class Trace, class Partitioner = tbb::auto_partitioner>
TraceReport trace_in_parallel(std::size_t count, std::size_t grain, const Trace& trace,
                              const Partitioner& partitioner = {}) {
    return tbb::parallel_reduce(
        Range(0, count, grain), TraceReport{},
        [&](const Range& range, TraceReport report) { return report += trace(range.begin(), range.end()); },
        [](TraceReport a, const TraceReport& b) { return a += b; }, partitioner);
}

}  // namespace

GridTracer::GridTracer(const rebuild::ResolutionPolicy& resolution, Traversal traversal,
                       const PacketOptions& packets)
    : traversal_(traversal), packets_(packets), builder_(resolution) {
    if (packets.side && (*packets.side < 1 || *packets.side > widest_packet_side)) {
        throw std::invalid_argument("a packet's side must be in [1, 16]");
    }
}

rebuild::BuildReport GridTracer::rebuild(const rebuild::TriangleView& triangles) {
    triangles_ = triangles;
    distances_most_ = 0;
    boxes_known_ = false;
    rebuild::BuildReport report = builder_.rebuild(triangles);
    if (packets_.macrocells) {
        const auto begun = std::chrono::steady_clock::now();
        macrocells_.rebuild(builder_.grid());
        const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - begun;
        report.total_ms += elapsed.count();
        report.bytes += macrocells_.bytes();
    }
    return report;
}

template <class Kernel, class Answers>
TraceReport GridTracer::trace_each(const GridScene& scene, const RayBatch& rays, Kernel kernel,
                                   Answers& answers) {
    const CellDigest cells = digest(rays.size());
    TraceReport report = trace_in_parallel(
        rays.size(), rays_per_task,
        [&](std::size_t first, std::size_t last) {
            return kernel(scene, cells, rays, resumed_, first, last, answers);
        },
        always_the_same);
    report.extra_bytes = digest_bytes();
    return report;
}

template <class Packets, class Kernel, class Answers>
TraceReport GridTracer::trace_loose(const GridScene& scene, const RayBatch& rays, const Packets& packets,
                                    Kernel streams, OcclusionBatch& left, Answers& answers) {
    TraceReport report;
    if (scene.grid.empty()) {
        std::fill(left.begin(), left.end(), undecided);
    } else {
        const PacketSource source(rays, resumed_, nullptr, packets_);
        report = trace_in_parallel(
            source.packet_count(), packets_per_task,
            [&](std::size_t first, std::size_t last) { return packets(source, first, last); });
    }
    if (report.rays < rays.size()) {
        // Those that are left are the ones whose cells are full: worth more than the average ray.
        const CellDigest cells = digest(hard_ray * (rays.size() - report.rays));
        report += trace_in_parallel(
            rays.size(), rays_per_task,
            [&](std::size_t first, std::size_t last) {
                return streams(scene, cells, rays, resumed_, Unanswered(left.data(), left.size()), first,
                               last, answers);
            },
            always_the_same);
        report.extra_bytes = digest_bytes();
    }
    report.rays = rays.size();
    return report;
}

TraceReport GridTracer::closest_hits(const RayBatch& rays, HitBatch& hits) {
    hits.resize(rays.size());
    if (rays.size() == 0) return {};
    const GridScene scene = begin(rays);
    if (traversal_ == Traversal::one_by_one) return trace_each(scene, rays, closest_one_by_one, hits);
    if (!in_packets(rays)) {
        left_.resize(rays.size());
        return trace_loose(
            scene, rays,
            [&](const PacketSource& source, std::size_t first, std::size_t last) {
                return closest_in_loose_packets(scene, source, first, last, hits, left_);
            },
            closest_in_streams, left_, hits);
    }
    const bool sorts = rays.order != RayOrder::coherent;
    const PacketSource source(rays, resumed_, sorts ? &ray_sort_.sort(rays) : nullptr, packets_);
    return trace_in_parallel(source.packet_count(), packets_per_task,
                             [&](std::size_t first, std::size_t last) {
                                 return closest_in_packets(scene, source, first, last, hits);
                             });
}

TraceReport GridTracer::any_hits(const RayBatch& rays, OcclusionBatch& occluded) {
    occluded.resize(rays.size());
    if (rays.size() == 0) return {};
    const GridScene scene = begin(rays);
    if (traversal_ == Traversal::one_by_one) return trace_each(scene, rays, any_one_by_one, occluded);
    if (!in_packets(rays)) {
        return trace_loose(
            scene, rays,
            [&](const PacketSource& source, std::size_t first, std::size_t last) {
                return any_in_loose_packets(scene, source, first, last, occluded);
            },
            any_in_streams, occluded, occluded);
    }
    TraceReport report;
    const SortedRays* sorted = nullptr;
    if (rays.order != RayOrder::coherent) {
        report = any_as_they_come(scene, rays, occluded);
        sorted = &ray_sort_.sort_undecided(rays, occluded);
    }
    const PacketSource source(rays, resumed_, sorted, packets_);
    report +=
        trace_in_parallel(source.packet_count(), packets_per_task, [&](std::size_t first, std::size_t last) {
            return any_in_packets(scene, source, first, last, occluded);
        });
    report.rays = rays.size();
    return report;
}

/// Neighbours in the batch are often neighbours in space, whoever says nothing about it.
TraceReport GridTracer::any_as_they_come(const GridScene& scene, const RayBatch& rays,
                                         OcclusionBatch& occluded) {
    const PacketSource source(rays, resumed_, nullptr, packets_);
    const std::size_t attempts = (source.packet_count() + packets_per_attempt - 1) / packets_per_attempt;
    return trace_in_parallel(attempts, 1, [&](std::size_t first, std::size_t last) {
        return any_where_cheap(scene, source, first * packets_per_attempt,
                               std::min(last * packets_per_attempt, source.packet_count()), occluded);
    });
}

GridScene GridTracer::begin(const RayBatch& rays) {
    resumed_.begin(rays, triangles_);
    return {.grid = builder_.grid(),
            .triangles = triangles_,
            .packets = packets_,
            .macrocells = packets_.macrocells ? &macrocells_ : nullptr};
}

/// Only what is not traced in packets asks for it, so whoever has no such rays does not pay.
CellDigest GridTracer::digest(std::size_t rays) {
    std::size_t references = 0;
    for (const rebuild::GridLevel& level : builder_.grid().levels) references += level.references.size();
    const bool few = rays < references / references_per_ray;
    const int most = few ? 1 : CellDistances::farthest;
    if (distances_most_ < most) distances_.rebuild(builder_.grid(), most);
    distances_most_ = std::max(distances_most_, most);
    if (few && !boxes_known_) return {.distances = distances_};
    if (!boxes_known_) boxes_.rebuild(builder_.grid(), triangles_);
    boxes_known_ = true;
    return {.distances = distances_, .boxes = &boxes_};
}

std::size_t GridTracer::digest_bytes() const {
    return distances_.bytes() + (boxes_known_ ? boxes_.bytes() : 0);
}

bool GridTracer::in_packets(const RayBatch& rays) const {
    if (traversal_ == Traversal::one_by_one) return false;
    // Without a way to run, no packet has axes.
    const bool parallel = rays.common_direction && !frame_of_parallel(rays).hits_nothing();
    return parallel || rays.common_origin.has_value();
}

}  // namespace gridreel::traversal
