#include "traversal/ray_sort.h"

#include "traversal/ray_sort_kernel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace gridreel::traversal {
namespace {

constexpr std::size_t rays_per_chunk = 1 << 13;  // fewer are not worth a thread

/// Bounds of slopes from a few thousand rays. Others may lie outside: they count as on the border, which
/// costs a little coherence and nothing else.
KeyMap key_map(const RayBatch& rays) {
    constexpr std::size_t samples = 4096;
    FaceBounds bounds;
    const std::size_t stride = rays.size() / samples | 1;  // odd, to be out of step with tiles of pixels
    for (std::size_t i = 0; i < rays.size(); i += stride) {
        const RayFrame ray = ray_frame(rays, i);
        if (!ray.hits_nothing()) bounds[ray.axes.face()].extend(ray.slope_u, ray.slope_v);
    }
    return KeyMap(bounds);
}

/// Stable, by eight bits of the keys from `shift` on.
template <class To>
void sort_by_digit(const std::uint64_t* from, To* to, std::size_t count, unsigned shift) {
    constexpr std::size_t values = 256;
    const auto digit = [shift](std::uint64_t key) { return key >> shift & (values - 1); };
    std::array<std::uint32_t, values> next{};
    for (std::size_t i = 0; i < count; ++i) ++next[digit(from[i])];
    std::uint32_t sum = 0;
    for (std::uint32_t& value : next) sum += std::exchange(value, sum);
    for (std::size_t i = 0; i < count; ++i) to[next[digit(from[i])]++] = static_cast<To>(from[i]);
}

/// From the keys of one bucket to its part of the order: as fine as so many rays need.
/// @param spare  room for as many keys
void sort_bucket(std::uint64_t* keys, std::size_t count, std::uint64_t* spare, std::uint32_t* order) {
    constexpr unsigned upper = 32 + RayKey::low_bits - 8;
    constexpr std::size_t few = 32;          // sooner sorted by comparing
    constexpr std::size_t one_digit = 2048;  // eight rays for each of its values
    if (count <= few) {
        std::sort(keys, keys + count);
        std::transform(keys, keys + count, order,
                       [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
    } else if (count <= one_digit) {
        sort_by_digit(keys, order, count, upper);
    } else {
        sort_by_digit(keys, spare, count, 32);
        sort_by_digit(spare, order, count, upper);
    }
}

}  // namespace

const SortedRays& RaySort::sort(const RayBatch& rays) {
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    chunks_.resize(std::clamp<std::size_t>(rays.size() / rays_per_chunk, 1, threads));
    sorted_.framed.resize(rays.size());
    sorted_.order.resize(rays.size());
    keys_.resize(rays.size());
    in_buckets_.resize(rays.size());

    make_keys(rays);
    scatter();
    sort_buckets();
    for (std::size_t face = 0; face <= face_count; ++face) {
        sorted_.face_begin[face] = bucket_begin_[face << RayKey::bucket_bits];
    }
    return sorted_;
}

std::size_t RaySort::chunk_begin(std::size_t chunk) const {
    if (chunk == chunks_.size()) return keys_.size();
    return keys_.size() * chunk / chunks_.size() / rays_per_register * rays_per_register;
}

void RaySort::make_keys(const RayBatch& rays) {
    const KeyMap map = key_map(rays);
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t chunk) {
        frame_rays(rays, chunk_begin(chunk), chunk_begin(chunk + 1), map, sorted_.framed.data(),
                   keys_.data());
        Histogram& counts = chunks_[chunk];
        counts.fill(0);
        for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i) {
            ++counts[bucket_of(keys_[i])];
        }
    });
}

void RaySort::scatter() {
    // Prefix sum over buckets, and within a bucket over chunks: equal keys keep their order.
    std::uint32_t sum = 0;
    for (std::size_t bucket = 0; bucket < RayKey::bucket_count; ++bucket) {
        bucket_begin_[bucket] = sum;
        for (Histogram& next : chunks_) sum += std::exchange(next[bucket], sum);
    }
    bucket_begin_.back() = sum;
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t chunk) {
        Histogram& next = chunks_[chunk];
        for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i) {
            in_buckets_[next[bucket_of(keys_[i])]++] = keys_[i];
        }
    });
}

void RaySort::sort_buckets() {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, RayKey::bucket_count), [&](const auto& buckets) {
        for (std::size_t bucket = buckets.begin(); bucket < buckets.end(); ++bucket) {
            const std::size_t begin = bucket_begin_[bucket];
            sort_bucket(in_buckets_.data() + begin, bucket_begin_[bucket + 1] - begin, keys_.data() + begin,
                        sorted_.order.data() + begin);
        }
    });
}

}  // namespace gridreel::traversal
