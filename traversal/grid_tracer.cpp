#include "traversal/grid_tracer.h"

#include "traversal/packet_kernel.h"
#include "traversal/single_ray_kernel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <vector>

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

/// What one task needs to trace packets; some 30 kB, too much for a careless stack.
struct Workspace {
    std::array<std::vector<FramedRay>, face_count> faces;
    Packet packet;
    Candidates candidates;
};

/// Sorts up to 256 neighbouring rays of a batch by frame and traces each frame's as a packet.
/// @param march   marches a loaded packet
/// @param finish  told of every ray: `miss`, or `hit` with its place in the marched packet
template <class March, class Finish>
TraceReport trace_neighbours(const RayBatch& rays, const ResumedRays& resumed,
                             std::span<const std::uint32_t> order, std::size_t begin, std::size_t end,
                             Workspace& work, const March& march, const Finish& finish) {
    for (auto& face : work.faces) face.clear();
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t ray = order.empty() ? static_cast<std::uint32_t>(i) : order[i];
        const RayFrame frame = resumed.frame(rays, ray);
        if (frame.hits_nothing()) {
            finish.miss(ray);
        } else {
            work.faces[frame.axes.face()].push_back({frame, ray});
        }
    }
    TraceReport report{.rays = end - begin};
    for (unsigned face = 0; face < face_count; ++face) {
        const std::vector<FramedRay>& framed = work.faces[face];
        if (framed.empty()) continue;
        load_packet(*rays.common_origin, axes_of_face(face), framed, work.packet);
        report += march(work.packet, work.candidates);
        for (std::size_t i = 0; i < framed.size(); ++i) finish.hit(framed[i], work.packet, i);
    }
    return report;
}

template <class March, class Finish>
TraceReport trace_in_packets(const RayBatch& rays, const ResumedRays& resumed,
                             std::span<const std::uint32_t> order, const March& march, const Finish& finish) {
    const std::size_t packets = (rays.size() + rays_per_packet - 1) / rays_per_packet;
    return trace_in_parallel(packets, packets_per_task, [&](std::size_t first, std::size_t last) {
        const auto work = std::make_unique<Workspace>();
        TraceReport report;
        for (std::size_t p = first; p < last; ++p) {
            const std::size_t begin = p * rays_per_packet;
            const std::size_t end = std::min(begin + rays_per_packet, rays.size());
            report += trace_neighbours(rays, resumed, order, begin, end, *work, march, finish);
        }
        return report;
    });
}

struct StoreHits {
    HitBatch& hits;

    void miss(std::uint32_t ray) const {
        hits.t[ray] = std::numeric_limits<float>::infinity();
        hits.triangle[ray] = no_triangle;
    }
    void hit(const FramedRay& ray, const Packet& packet, std::size_t lane) const {
        if (!(packet.depth[lane] < ray.frame.depth_max)) return miss(ray.ray);
        hits.t[ray.ray] = ray.frame.t_of(packet.depth[lane]);
        hits.triangle[ray.ray] = packet.triangle[lane];
    }
};

struct StoreOcclusion {
    OcclusionBatch& occluded;

    void miss(std::uint32_t ray) const { occluded[ray] = 0; }
    void hit(const FramedRay& ray, const Packet& packet, std::size_t lane) const {
        occluded[ray.ray] = packet.depth[lane] < 0.0f;
    }
};

}  // namespace

GridTracer::GridTracer(const rebuild::ResolutionPolicy& resolution, Traversal traversal)
    : traversal_(traversal), builder_(resolution) {}

rebuild::BuildReport GridTracer::rebuild(const rebuild::TriangleView& triangles) {
    triangles_ = triangles;
    return builder_.rebuild(triangles);
}

TraceReport GridTracer::closest_hits(const RayBatch& rays, HitBatch& hits) {
    hits.resize(rays.size());
    resumed_.begin(rays, triangles_);
    const GridScene scene{builder_.grid(), triangles_};
    if (in_packets(rays)) {
        return trace_in_packets(
            rays, resumed_, order_of(rays),
            [&](Packet& packet, Candidates& candidates) { return march_closest(scene, packet, candidates); },
            StoreHits{hits});
    }
    return trace_in_parallel(rays.size(), rays_per_task, [&](std::size_t begin, std::size_t end) {
        return closest_one_by_one(scene, rays, resumed_, begin, end, hits);
    });
}

TraceReport GridTracer::any_hits(const RayBatch& rays, OcclusionBatch& occluded) {
    occluded.resize(rays.size());
    resumed_.begin(rays, triangles_);
    const GridScene scene{builder_.grid(), triangles_};
    if (in_packets(rays)) {
        return trace_in_packets(
            rays, resumed_, order_of(rays),
            [&](Packet& packet, Candidates& candidates) { return march_any(scene, packet, candidates); },
            StoreOcclusion{occluded});
    }
    return trace_in_parallel(rays.size(), rays_per_task, [&](std::size_t begin, std::size_t end) {
        return any_one_by_one(scene, rays, resumed_, begin, end, occluded);
    });
}

bool GridTracer::in_packets(const RayBatch& rays) const {
    return traversal_ == Traversal::coherent && rays.common_origin.has_value();
}

/// Empty: the batch's own order.
std::span<const std::uint32_t> GridTracer::order_of(const RayBatch& rays) {
    if (rays.order == RayOrder::coherent) return {};
    ray_sort_.sort(rays, order_);
    return order_.span();
}

}  // namespace gridreel::traversal
