#include "traversal/ray_sort.h"

#include "traversal/radix_sort.h"
#include "traversal/ray_frame.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace gridreel::traversal {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t grain = 1 << 13;
constexpr unsigned slope_bits = 14;
constexpr unsigned key_bits = 2 * slope_bits + 3;

/// The slopes that occur on one face of the cube of directions.
struct SlopeBounds {
    float low_u = 2.0f, high_u = -2.0f, low_v = 2.0f, high_v = -2.0f;

    void extend(const RayFrame& ray) {
        low_u = std::min(low_u, ray.slope_u);
        high_u = std::max(high_u, ray.slope_u);
        low_v = std::min(low_v, ray.slope_v);
        high_v = std::max(high_v, ray.slope_v);
    }
    void extend(const SlopeBounds& other) {
        low_u = std::min(low_u, other.low_u);
        high_u = std::max(high_u, other.high_u);
        low_v = std::min(low_v, other.low_v);
        high_v = std::max(high_v, other.high_v);
    }
};
using FaceBounds = std::array<SlopeBounds, face_count>;

FaceBounds bounds_of(const RayBatch& rays) {
    return tbb::parallel_reduce(
        Range(0, rays.size(), grain), FaceBounds{},
        [&](const Range& range, FaceBounds bounds) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) {
                const RayFrame ray = ray_frame(rays, i);
                if (!ray.hits_nothing()) bounds[ray.axes.face()].extend(ray);
            }
            return bounds;
        },
        [](FaceBounds a, const FaceBounds& b) {
            for (std::size_t face = 0; face < face_count; ++face) a[face].extend(b[face]);
            return a;
        });
}

/// Bits of x at the even places.
std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

std::uint32_t key_of(const RayFrame& ray, const FaceBounds& bounds) {
    if (ray.hits_nothing()) return face_count << 2 * slope_bits;
    const SlopeBounds& box = bounds[ray.axes.face()];
    // One scale for both axes, so that the curve's squares are squares of slopes.
    const float extent = std::max({box.high_u - box.low_u, box.high_v - box.low_v, 1e-30f});
    const float last = float((1u << slope_bits) - 1u);
    const auto place = [&](float slope, float low) {
        return spread_bits(static_cast<std::uint32_t>((slope - low) / extent * last));
    };
    return ray.axes.face() << 2 * slope_bits | place(ray.slope_v, box.low_v) << 1 |
           place(ray.slope_u, box.low_u);
}

}  // namespace

void RaySort::sort(const RayBatch& rays, rebuild::Buffer<std::uint32_t>& order) {
    const FaceBounds bounds = bounds_of(rays);
    keys_.resize(rays.size());
    tbb::parallel_for(Range(0, rays.size(), grain), [&](const Range& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            keys_[i] = std::uint64_t{key_of(ray_frame(rays, i), bounds)} << 32 | i;
        }
    });
    radix_sort(keys_, sorted_, key_bits);
    order.resize(rays.size());
    tbb::parallel_for(Range(0, rays.size(), grain), [&](const Range& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            order[i] = static_cast<std::uint32_t>(keys_[i]);
    });
}

}  // namespace gridreel::traversal
