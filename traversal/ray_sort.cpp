#include "traversal/ray_sort.h"

#include "traversal/ray_sort_kernel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <type_traits>
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
    return {bounds, rays.size()};
}

template <class To>
To as(std::uint64_t key) {
    if constexpr (std::is_same_v<To, RayRun>) {
        return RayRun(static_cast<std::uint32_t>(key));
    } else {
        return key;
    }
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
    for (std::size_t i = 0; i < count; ++i) to[next[digit(from[i])]++] = as<To>(from[i]);
}

/// From the keys of one bucket to its part of the order: as fine as so many rays need.
/// @param spare  room for as many keys
void sort_bucket(std::uint64_t* keys, std::size_t count, std::uint64_t* spare, RayRun* order) {
    constexpr unsigned upper = 32 + RayKey::low_bits - 8;
    constexpr std::size_t few = 32;          // sooner sorted by comparing
    constexpr std::size_t one_digit = 2048;  // eight runs for each of its values
    if (count <= few) {
        std::sort(keys, keys + count);
        std::transform(keys, keys + count, order, as<RayRun>);
    } else if (count <= one_digit) {
        sort_by_digit(keys, order, count, upper);
    } else {
        sort_by_digit(keys, spare, count, 32);
        sort_by_digit(spare, order, count, upper);
    }
}

}  // namespace

const SortedRays& RaySort::sort(const RayBatch& rays) {
    assert(rays.size() < std::size_t{1} << 31);
    cut_chunks(rays.size());
    sorted_.framed.resize(rays.size());
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

void RaySort::cut_chunks(std::size_t ray_count) {
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    chunks_.resize(std::clamp<std::size_t>(ray_count / rays_per_chunk, 1, threads));
    std::size_t begin = 0;
    for (std::size_t i = 0; i < chunks_.size(); ++i) {
        const std::size_t end = ray_count * (i + 1) / chunks_.size() / rays_per_register * rays_per_register;
        chunks_[i].begin = begin;
        chunks_[i].end = begin = i + 1 == chunks_.size() ? ray_count : end;
    }
}

void RaySort::make_keys(const RayBatch& rays) {
    const KeyMap map = key_map(rays);
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t i) {
        Chunk& chunk = chunks_[i];
        chunk.run_count = frame_rays(rays, chunk.begin, chunk.end, map, sorted_.framed.data(), keys_.data());
        chunk.next.fill(0);
        for (std::size_t run = 0; run < chunk.run_count; ++run) {
            ++chunk.next[bucket_of(keys_[chunk.begin + run])];
        }
    });
}

void RaySort::scatter() {
    // Prefix sum over buckets, and within a bucket over chunks: equal keys keep their order.
    std::uint32_t sum = 0;
    for (std::size_t bucket = 0; bucket < RayKey::bucket_count; ++bucket) {
        bucket_begin_[bucket] = sum;
        for (Chunk& chunk : chunks_) sum += std::exchange(chunk.next[bucket], sum);
    }
    bucket_begin_.back() = sum;
    sorted_.order.resize(sum);
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t i) {
        Chunk& chunk = chunks_[i];
        for (std::size_t run = 0; run < chunk.run_count; ++run) {
            const std::uint64_t key = keys_[chunk.begin + run];
            in_buckets_[chunk.next[bucket_of(key)]++] = key;
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
