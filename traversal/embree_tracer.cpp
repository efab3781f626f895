#include "traversal/embree_tracer.h"

#include "traversal/embree_api-inl.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace gridreel::traversal {
namespace {

using embree::Context;
using embree::Query;

constexpr std::size_t width = 16;
constexpr std::size_t rays_per_task = 64 * width;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Embree's manual asks for tiny numbers to be flushed to zero while it traces.
class FlushTinyNumbers {
public:
#ifdef __SSE__
    FlushTinyNumbers() : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | 0x8040u);
    }
    FlushTinyNumbers(const FlushTinyNumbers&) = delete;
    FlushTinyNumbers& operator=(const FlushTinyNumbers&) = delete;
    ~FlushTinyNumbers() {
        _mm_setcsr(before_);
    }

private:
    unsigned before_;
#endif
};

bool can_hit(const glm::vec3& origin, const glm::vec3& direction, float t_min, float t_max) {
    const glm::vec3 reach = glm::abs(direction);
    return t_min < t_max && rebuild::is_traceable(origin) && direction != glm::vec3(0.0f) &&
           reach.x < infinity && reach.y < infinity && reach.z < infinity;
}

/// Rays in Embree's way ---------------------------------------------------------------------------------

/// The rays of one packet: `count` of them from `first` on, in the batch's own order or another.
struct Lanes {
    std::size_t first = 0, count = 0;
    const std::uint32_t* order = nullptr;

    [[nodiscard]] std::size_t ray(std::size_t lane) const {
        return order ? order[first + lane] : first + lane;
    }
};

void copy_lanes(const rebuild::Buffer<float>& from, const Lanes& lanes, float* to) {
    if (lanes.order) {
        for (std::size_t i = 0; i < lanes.count; ++i) to[i] = from[lanes.order[lanes.first + i]];
    } else if (lanes.count == width) {
        std::memcpy(to, from.data() + lanes.first, width * sizeof(float));
    } else {
        std::copy_n(from.data() + lanes.first, lanes.count, to);
    }
}

/// x, y and z of what rays have in common, or each of its own.
void fill_axes(const std::optional<glm::vec3>& common, const std::array<rebuild::Buffer<float>, 3>& own,
               const Lanes& lanes, const std::array<float*, 3>& to) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (common) {
            std::fill_n(to[axis], width, (*common)[static_cast<int>(axis)]);
        } else {
            copy_lanes(own[axis], lanes, to[axis]);
        }
    }
}

/// Fills a packet, and says which of its rays can hit anything.
void fill(const RayBatch& rays, const Lanes& lanes, RTCRay16& packet, std::array<int, width>& valid) {
    fill_axes(rays.common_origin, rays.origin, lanes, {packet.org_x, packet.org_y, packet.org_z});
    fill_axes(rays.common_direction, rays.direction, lanes, {packet.dir_x, packet.dir_y, packet.dir_z});
    copy_lanes(rays.t_min, lanes, packet.tnear);
    copy_lanes(rays.t_max, lanes, packet.tfar);
    std::fill_n(packet.time, width, 0.0f);
    std::fill_n(packet.mask, width, ~0u);
    std::fill_n(packet.flags, width, 0u);

    // `can_hit`, by comparisons joined with & so that they are done side by side.
    constexpr float largest = rebuild::largest_coordinate;
    for (std::size_t i = 0; i < width; ++i) {
        const float x = std::fabs(packet.dir_x[i]);
        const float y = std::fabs(packet.dir_y[i]);
        const float z = std::fabs(packet.dir_z[i]);
        const int sound =
            int(packet.tnear[i] < packet.tfar[i]) & int(x < infinity) & int(y < infinity) &
            int(z < infinity) & int(x + y + z > 0.0f) & int(std::fabs(packet.org_x[i]) <= largest) &
            int(std::fabs(packet.org_y[i]) <= largest) & int(std::fabs(packet.org_z[i]) <= largest);
        valid[i] = -sound;
    }
    std::fill(valid.begin() + static_cast<std::ptrdiff_t>(lanes.count), valid.end(), 0);
}

RTCRay single_ray(const RayBatch& rays, std::size_t index, float t_min) {
    const glm::vec3 origin = rays.origin_of(index);
    const glm::vec3 direction = rays.direction_of(index);
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.tnear = t_min;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    // Embree goes through with an empty interval; a negative end tells it that the ray is done.
    ray.tfar = can_hit(origin, direction, t_min, rays.t_max[index]) ? rays.t_max[index] : -infinity;
    ray.mask = ~0u;
    ray.id = static_cast<unsigned>(index);
    return ray;
}

/// Going on behind a triangle ---------------------------------------------------------------------------

/// Where a triangle comes in the order of a ray's hits.
struct Place {
    double t = 0.0;  ///< of the triangle's plane; not-a-number when seen edge-on
    std::uint32_t triangle = 0;

    [[nodiscard]] bool comes_after(const Place& other) const {
        return t > other.t || (t == other.t && triangle > other.triangle);
    }
};

Place place_of(const rebuild::TriangleView& triangles, std::uint32_t triangle, const RayBatch& rays,
               std::size_t ray) {
    const glm::uvec3& corners = triangles.triangles[triangle];
    const glm::dvec3 a(triangles.positions[corners.x]);
    const glm::dvec3 normal = glm::cross(glm::dvec3(triangles.positions[corners.y]) - a,
                                         glm::dvec3(triangles.positions[corners.z]) - a);
    const double t = glm::dot(normal, a - glm::dvec3(rays.origin_of(ray))) /
                     glm::dot(normal, glm::dvec3(rays.direction_of(ray)));
    return {.t = t, .triangle = triangle};
}

/// The context that `only_behind` sees: Embree hands on the pointer to its first member.
struct ResumedContext {
    Context embree{};
    const RayBatch* rays = nullptr;
    const rebuild::TriangleView* triangles = nullptr;
    Place after;
};

/// Refuses hits that do not come after the triangle that the ray goes on behind. For single rays.
void only_behind(const RTCFilterFunctionNArguments* hit) {
    const auto& resumed = *reinterpret_cast<const ResumedContext*>(hit->context);
    const std::size_t ray = RTCRayN_id(hit->ray, hit->N, 0);
    const std::uint32_t triangle = RTCHitN_primID(hit->hit, hit->N, 0);
    if (!place_of(*resumed.triangles, triangle, *resumed.rays, ray).comes_after(resumed.after)) {
        hit->valid[0] = 0;
    }
}

/// Where to begin looking: somewhat before the triangle, since Embree rounds in its own way.
float begin_of(const Place& after) {
    constexpr double caution = 1.0 - 1e-4;
    return std::max(0.0f, static_cast<float>(after.t * caution));
}

/// Single rays behind their triangles; `trace` is called with each, ready to go.
template <class Trace>
void for_each_resumed(const RayBatch& rays, const rebuild::TriangleView& triangles, std::size_t begin,
                      std::size_t end, const Trace& trace) {
    ResumedContext context{.rays = &rays, .triangles = &triangles, .after = {}};
    Query query(context.embree, false, only_behind);
    for (std::size_t i = begin; i < end; ++i) {
        context.after = place_of(triangles, rays.after_triangle[i], rays, i);
        trace(i, query, single_ray(rays, i, begin_of(context.after)));
    }
}

/// Asking -----------------------------------------------------------------------------------------------

template <class Trace>
void for_each_single(const RayBatch& rays, std::size_t begin, std::size_t end, const Trace& trace) {
    Context context;
    Query query(context, false, nullptr);
    for (std::size_t i = begin; i < end; ++i) trace(i, query, single_ray(rays, i, rays.t_min[i]));
}

/// Which rays of a batch to trace in packets, and how.
struct PacketRun {
    std::size_t begin = 0, end = 0;
    const std::uint32_t* order = nullptr;
    bool coherent = false;

    [[nodiscard]] Lanes lanes(std::size_t first) const {
        return {.first = first, .count = std::min(width, end - first), .order = order};
    }
};

void closest_in_packets(RTCScene scene, const RayBatch& rays, const PacketRun& run, HitBatch& hits) {
    Context context;
    Query query(context, run.coherent, nullptr);
    RTCRayHit16 packet{};
    alignas(64) std::array<int, width> valid{};
    for (std::size_t first = run.begin; first < run.end; first += width) {
        const Lanes lanes = run.lanes(first);
        fill(rays, lanes, packet.ray, valid);
        std::fill_n(packet.hit.geomID, width, RTC_INVALID_GEOMETRY_ID);
        std::fill_n(packet.hit.primID, width, no_triangle);
        embree::intersect(scene, query, packet, valid.data());
        for (std::size_t i = 0; i < lanes.count; ++i) {
            const bool missed = packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID;
            hits.t[lanes.ray(i)] = missed ? infinity : packet.ray.tfar[i];
            hits.triangle[lanes.ray(i)] = missed ? no_triangle : packet.hit.primID[i];
        }
    }
}

void any_in_packets(RTCScene scene, const RayBatch& rays, const PacketRun& run, OcclusionBatch& occluded) {
    Context context;
    Query query(context, run.coherent, nullptr);
    RTCRay16 packet{};
    alignas(64) std::array<int, width> valid{};
    for (std::size_t first = run.begin; first < run.end; first += width) {
        const Lanes lanes = run.lanes(first);
        fill(rays, lanes, packet, valid);
        embree::occluded(scene, query, packet, valid.data());
        for (std::size_t i = 0; i < lanes.count; ++i) {
            occluded[lanes.ray(i)] = valid[i] != 0 && packet.tfar[i] < 0.0f;
        }
    }
}

template <class Work>
void in_parallel(std::size_t count, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (count + width - 1) / width, rays_per_task / width),
                      [&](const auto& range) {
                          const FlushTinyNumbers flush;
                          work(range.begin() * width, std::min(range.end() * width, count));
                      });
}

bool are_neighbours(const RayBatch& rays) {
    return rays.order == RayOrder::coherent || rays.common_origin || rays.common_direction;
}

}  // namespace

EmbreeTracer::EmbreeTracer(const EmbreeOptions& options)
    : options_(options), way_(options.rays), scene_(options.quality) {}

rebuild::BuildReport EmbreeTracer::rebuild(const rebuild::TriangleView& triangles) {
    triangles_ = triangles;
    return scene_.build(triangles);
}

/// @param packets  traces a `PacketRun`
/// @param single   traces one ray: its position, the query and the ray
template <class Packets, class Single>
TraceReport EmbreeTracer::trace(const RayBatch& rays, const Packets& packets, const Single& single) {
    const bool resumed = !rays.after_triangle.empty();
    if (resumed) scene_.allow_filters();
    const std::uint32_t* const order = resumed ? nullptr : order_of(rays);
    in_parallel(rays.size(), [&](std::size_t begin, std::size_t end) {
        if (resumed) {
            for_each_resumed(rays, triangles_, begin, end, single);
        } else if (in_packets(rays)) {
            packets({.begin = begin, .end = end, .order = order, .coherent = are_neighbours(rays)});
        } else {
            for_each_single(rays, begin, end, single);
        }
    });
    return {.rays = rays.size()};
}

TraceReport EmbreeTracer::closest_hits(const RayBatch& rays, HitBatch& hits) {
    hits.resize(rays.size());
    if (scene_.empty()) {
        std::fill(hits.t.begin(), hits.t.end(), infinity);
        std::fill(hits.triangle.begin(), hits.triangle.end(), no_triangle);
        return {.rays = rays.size()};
    }
    return trace(
        rays, [&](const PacketRun& run) { closest_in_packets(scene_.handle(), rays, run, hits); },
        [&](std::size_t i, Query& query, const RTCRay& ray) {
            RTCRayHit asked{.ray = ray, .hit = {}};
            asked.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            if (ray.tfar >= 0.0f) embree::intersect(scene_.handle(), query, asked);
            const bool missed = asked.hit.geomID == RTC_INVALID_GEOMETRY_ID;
            hits.t[i] = missed ? infinity : asked.ray.tfar;
            hits.triangle[i] = missed ? no_triangle : asked.hit.primID;
        });
}

TraceReport EmbreeTracer::any_hits(const RayBatch& rays, OcclusionBatch& occluded) {
    occluded.resize(rays.size());
    if (scene_.empty()) {
        std::fill(occluded.begin(), occluded.end(), std::uint8_t{0});
        return {.rays = rays.size()};
    }
    return trace(
        rays, [&](const PacketRun& run) { any_in_packets(scene_.handle(), rays, run, occluded); },
        [&](std::size_t i, Query& query, RTCRay ray) {
            const bool possible = ray.tfar >= 0.0f;
            if (possible) embree::occluded(scene_.handle(), query, ray);
            occluded[i] = possible && ray.tfar < 0.0f;
        });
}

std::span<const std::string_view> EmbreeTracer::ways() const {
    static constexpr std::array<std::string_view, 3> all{"packets", "sorted packets", "single"};
    const auto only = [](std::size_t way) { return std::span(all).subspan(way, 1); };
    switch (options_.rays) {
        case EmbreeRays::automatic:
            break;
        case EmbreeRays::packets:
            return only(0);
        case EmbreeRays::sorted:
            return only(1);
        case EmbreeRays::single:
            return only(2);
    }
    return all;
}

void EmbreeTracer::take_way(std::size_t way) {
    constexpr std::array all{EmbreeRays::packets, EmbreeRays::sorted, EmbreeRays::single};
    if (options_.rays == EmbreeRays::automatic) way_ = all[way];
}

bool EmbreeTracer::in_packets(const RayBatch& rays) const {
    return way_ == EmbreeRays::automatic ? are_neighbours(rays) : way_ != EmbreeRays::single;
}

const std::uint32_t* EmbreeTracer::order_of(const RayBatch& rays) {
    const bool sorts = way_ == EmbreeRays::sorted && (rays.common_origin || rays.common_direction) &&
                       rays.order == RayOrder::arbitrary;
    return sorts ? ray_sort_.sort(rays).order.data() : nullptr;
}

}  // namespace gridreel::traversal
