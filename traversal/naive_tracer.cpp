#include "traversal/naive_tracer.h"

#include "traversal/naive_kernel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <chrono>
#include <limits>

namespace gridreel::traversal {
namespace {

constexpr std::size_t rays_per_task = 256;

std::size_t padded(std::size_t count) {
    return (count + naive_padding - 1) / naive_padding * naive_padding;
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<glm::vec3, 3> never_hit{glm::vec3{nan}, glm::vec3{nan}, glm::vec3{nan}};

std::array<glm::vec3, 3> traceable_corners(const rebuild::TriangleView& triangles, std::size_t index) {
    const glm::uvec3& corners = triangles.triangles[index];
    const glm::vec3& a = triangles.positions[corners.x];
    const glm::vec3& b = triangles.positions[corners.y];
    const glm::vec3& c = triangles.positions[corners.z];
    if (!rebuild::is_traceable(a) || !rebuild::is_traceable(b) || !rebuild::is_traceable(c)) return never_hit;
    return {a, b, c};
}

template <class Store>
TraceReport trace(const RayBatch& rays, const ResumedRays& resumed, const CornerRuns& corners,
                  const Store& store) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), rays_per_task), [&](const auto& range) {
        for (std::size_t ray = range.begin(); ray < range.end(); ++ray) {
            const RayFrame frame = resumed.frame(rays, ray);
            const glm::vec3 origin = rays.origin_of(ray);
            const bool traceable = !frame.hits_nothing() && rebuild::is_traceable(origin);
            const DepthHit hit = traceable ? closest_of_all(corners, origin, frame) : DepthHit{};
            store(ray, frame, hit);
        }
    });
    return {.rays = rays.size(), .triangle_tests = rays.size() * corners.count};
}

}  // namespace

rebuild::BuildReport NaiveTracer::rebuild(const rebuild::TriangleView& triangles) {
    const auto start = std::chrono::steady_clock::now();
    triangles_ = triangles;
    const std::size_t run = padded(triangles_.size());
    corners_.resize(9 * run);
    for (std::size_t i = 0; i < run; ++i) {
        const std::array<glm::vec3, 3> corners =
            i < triangles_.size() ? traceable_corners(triangles, i) : never_hit;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                corners_[(3 * corner + axis) * run + i] = corners[corner][static_cast<int>(axis)];
            }
        }
    }
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    return {.total_ms = elapsed.count(), .bytes = corners_.bytes()};
}

TraceReport NaiveTracer::closest_hits(const RayBatch& rays, HitBatch& hits) {
    hits.resize(rays.size());
    resumed_.begin(rays, triangles_);
    const CornerRuns corners{corners_.data(), triangles_.size(), padded(triangles_.size())};
    return trace(rays, resumed_, corners, [&](std::size_t ray, const RayFrame& frame, const DepthHit& hit) {
        const bool missed = hit.triangle == no_triangle;
        hits.t[ray] = missed ? std::numeric_limits<float>::infinity() : frame.t_of(hit.depth);
        hits.triangle[ray] = hit.triangle;
    });
}

TraceReport NaiveTracer::any_hits(const RayBatch& rays, OcclusionBatch& occluded) {
    occluded.resize(rays.size());
    resumed_.begin(rays, triangles_);
    const CornerRuns corners{corners_.data(), triangles_.size(), padded(triangles_.size())};
    return trace(rays, resumed_, corners, [&](std::size_t ray, const RayFrame&, const DepthHit& hit) {
        occluded[ray] = hit.triangle != no_triangle;
    });
}

}  // namespace gridreel::traversal
