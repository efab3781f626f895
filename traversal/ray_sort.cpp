#include "traversal/ray_sort.h"

#include "traversal/ray_sort_kernel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

namespace gridreel::traversal {
namespace {

constexpr std::size_t rays_per_chunk = 1 << 13;  // fewer are not worth a thread

/// The slopes that occur on one face of the cube of directions.
struct SlopeBounds {
    float low_u = 2.0f, high_u = -2.0f, low_v = 2.0f, high_v = -2.0f;

    [[nodiscard]] bool empty() const { return low_u > high_u; }

    void extend(float u, float v) {
        low_u = std::min(low_u, u);
        high_u = std::max(high_u, u);
        low_v = std::min(low_v, v);
        high_v = std::max(high_v, v);
    }
};
using FaceBounds = std::array<SlopeBounds, face_count>;

/// Bounds of a few thousand rays. Others may lie outside: they count as on the border, which costs a little
/// coherence and nothing else.
FaceBounds sampled_bounds(const RayBatch& rays) {
    constexpr std::size_t samples = 4096;
    FaceBounds bounds;
    const std::size_t stride = rays.size() / samples | 1;  // odd, to be out of step with tiles of pixels
    for (std::size_t i = 0; i < rays.size(); i += stride) {
        const RayFrame ray = ray_frame(rays, i);
        if (!ray.hits_nothing()) bounds[ray.axes.face()].extend(ray.slope_u, ray.slope_v);
    }
    return bounds;
}

KeyMap key_map(const FaceBounds& bounds) {
    KeyMap map;
    for (std::size_t face = 0; face < face_count; ++face) {
        constexpr SlopeBounds whole{.low_u = -1.0f, .high_u = 1.0f, .low_v = -1.0f, .high_v = 1.0f};
        const SlopeBounds& box = bounds[face].empty() ? whole : bounds[face];
        // One scale for both axes, so that the curve's squares are squares of slopes.
        const float extent = std::max({box.high_u - box.low_u, box.high_v - box.low_v, 1e-30f});
        map.low_u[face] = box.low_u;
        map.low_v[face] = box.low_v;
        map.scale[face] = RayKey::last_cell / extent;
    }
    return map;
}

constexpr unsigned digit_bits = 8;
static_assert(digit_bits <= RayKey::rest_bits &&
              RayKey::rest_bits <= 2 * digit_bits);  // two, maybe overlapping
constexpr unsigned lower_digit = RayKey::position_bits;
constexpr unsigned upper_digit = lower_digit + RayKey::rest_bits - digit_bits;

/// Stable, by the digit of the keys from `shift` on.
template <class To>
void sort_by_digit(const std::uint64_t* from, To* to, std::size_t count, unsigned shift) {
    constexpr std::size_t values = 1u << digit_bits;
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
    constexpr std::size_t few = 32;                      // sooner sorted by comparing
    constexpr std::size_t one_digit = 8u << digit_bits;  // eight rays for each value
    if (count <= few) {
        std::sort(keys, keys + count);
        std::transform(keys, keys + count, order,
                       [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
    } else if (count <= one_digit) {
        sort_by_digit(keys, order, count, upper_digit);
    } else {
        sort_by_digit(keys, spare, count, lower_digit);
        sort_by_digit(spare, order, count, upper_digit);
    }
}

}  // namespace

const SortedRays& RaySort::sort(const RayBatch& rays) {
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    histograms_.resize(std::clamp<std::size_t>(rays.size() / rays_per_chunk, 1, threads));
    sorted_.framed.resize(rays.size());
    sorted_.order.resize(rays.size());
    keys_.resize(rays.size());
    in_buckets_.resize(rays.size());

    key_and_count(rays);
    scatter();
    sort_buckets();
    for (std::size_t face = 0; face <= face_count; ++face) {
        sorted_.face_begin[face] = bucket_begin_[face << RayKey::bucket_bits];
    }
    return sorted_;
}

std::size_t RaySort::chunk_begin(std::size_t chunk) const {
    if (chunk == histograms_.size()) return keys_.size();
    return keys_.size() * chunk / histograms_.size() / rays_per_step * rays_per_step;
}

void RaySort::key_and_count(const RayBatch& rays) {
    const KeyMap map = key_map(sampled_bounds(rays));
    tbb::parallel_for(std::size_t{0}, histograms_.size(), [&](std::size_t chunk) {
        frame_and_key(rays, chunk_begin(chunk), chunk_begin(chunk + 1), map, sorted_.framed.data(),
                      keys_.data());
        Histogram& counts = histograms_[chunk];
        counts.fill(0);
        for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i) {
            ++counts[RayKey::bucket(keys_[i])];
        }
    });
}

void RaySort::scatter() {
    // Prefix sum over buckets, and within a bucket over chunks: equal keys keep their order.
    std::uint32_t sum = 0;
    for (std::size_t bucket = 0; bucket < RayKey::bucket_count; ++bucket) {
        bucket_begin_[bucket] = sum;
        for (Histogram& next : histograms_) sum += std::exchange(next[bucket], sum);
    }
    bucket_begin_.back() = sum;
    tbb::parallel_for(std::size_t{0}, histograms_.size(), [&](std::size_t chunk) {
        Histogram& next = histograms_[chunk];
        for (std::size_t i = chunk_begin(chunk); i < chunk_begin(chunk + 1); ++i) {
            in_buckets_[next[RayKey::bucket(keys_[i])]++] = keys_[i];
        }
    });
}

void RaySort::sort_buckets() {
    std::uint64_t* const spare = keys_.data();
    tbb::parallel_for(std::size_t{0}, RayKey::bucket_count, [&](std::size_t bucket) {
        const std::size_t begin = bucket_begin_[bucket];
        sort_bucket(in_buckets_.data() + begin, bucket_begin_[bucket + 1] - begin, spare + begin,
                    sorted_.order.data() + begin);
    });
}

}  // namespace gridreel::traversal
