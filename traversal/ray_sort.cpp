#include "traversal/ray_sort.h"

#include "rebuild/triangle_view.h"
#include "traversal/ray_sort_kernel.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gridreel::traversal {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t rays_per_chunk = 1 << 13;  // fewer are not worth a thread

/// The slopes, or places of parallel rays, that occur on one face of the cube of directions.
struct SlopeBounds {
    float low_u = infinity, high_u = -infinity, low_v = infinity, high_v = -infinity;

    [[nodiscard]] bool empty() const { return low_u > high_u; }

    void extend(float u, float v) {
        low_u = std::min(low_u, u);
        high_u = std::max(high_u, u);
        low_v = std::min(low_v, v);
        high_v = std::max(high_v, v);
    }
};
using FaceBounds = std::array<SlopeBounds, face_count>;

/// Bounds of up to a few thousand of the rays that are wanted. Others may lie outside: they count as on the
/// border, which costs a little coherence and nothing else.
FaceBounds sampled_bounds(const RayBatch& rays, const OcclusionBatch* only) {
    constexpr std::size_t samples = 4096;
    FaceBounds bounds;
    const std::size_t stride = rays.size() / samples | 1;  // odd, to be out of step with tiles of pixels
    for (std::size_t i = 0; i < rays.size(); i += stride) {
        if (only != nullptr && (*only)[i] != undecided) continue;
        const RayFrame ray = ray_frame(rays, i);
        if (ray.hits_nothing()) continue;
        SlopeBounds& box = bounds[ray.axes.face()];
        if (!rays.common_direction) {
            box.extend(ray.slope_u, ray.slope_v);
            continue;
        }
        const glm::vec3 origin = rays.origin_of(i);
        if (!rebuild::is_traceable(origin)) continue;
        const float depth = ray.axes.sign() * origin[ray.axes.k];
        box.extend(origin[ray.axes.u()] - ray.slope_u * depth, origin[ray.axes.v()] - ray.slope_v * depth);
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

/// Bits of the digit that so many keys are sorted by: about eight keys share its value.
unsigned digit_bits_for(std::size_t count) {
    constexpr unsigned least = 2, most = 8, shared_bits = 3;
    return std::clamp(static_cast<unsigned>(std::bit_width(count)), least + shared_bits, most + shared_bits) -
           shared_bits;
}
constexpr std::size_t most_digit_values = std::size_t{1} << 8;

/// Sorts the keys of one bucket, or of one part of it, and writes their positions: digit by digit from the
/// highest on, as long as more rays share it than a few blocks hold.
/// @param digit_end  keys agree in all bits from this one on
/// @param spare      room for as many keys
void sort_bucket(std::uint64_t* keys, std::size_t count, unsigned digit_end, std::uint64_t* spare,
                 std::uint32_t* order) {
    constexpr std::size_t few = 32;  // sooner sorted by comparing
    const auto position = [](std::uint64_t key) {
        return static_cast<std::uint32_t>(key & RayKey::position_mask);
    };
    if (count <= few || digit_end == RayKey::position_bits) {
        if (digit_end > RayKey::position_bits) std::sort(keys, keys + count);
        std::transform(keys, keys + count, order, position);
        return;
    }
    const unsigned digit_bits = digit_bits_for(count);
    const std::size_t digit_values = std::size_t{1} << digit_bits;
    const unsigned shift = std::max(RayKey::position_bits + digit_bits, digit_end) - digit_bits;
    const auto digit = [&](std::uint64_t key) { return key >> shift & (digit_values - 1); };
    std::array<std::uint32_t, most_digit_values + 1> begin;
    std::fill_n(begin.begin(), digit_values + 1, 0u);
    for (std::size_t i = 0; i < count; ++i) ++begin[digit(keys[i]) + 1];
    std::uint32_t most = 0;
    for (std::size_t value = 1; value <= digit_values; ++value) {
        most = std::max(most, begin[value]);
        begin[value] += begin[value - 1];
    }
    std::array<std::uint32_t, most_digit_values> next;
    std::copy_n(begin.begin(), digit_values, next.begin());
    if (most <= few) {  // and those in the batch's order
        for (std::size_t i = 0; i < count; ++i) order[next[digit(keys[i])]++] = position(keys[i]);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) spare[next[digit(keys[i])]++] = keys[i];
    const auto sort_part = [&](std::size_t value) {
        const std::size_t first = begin[value], size = begin[value + 1] - first;
        if (size <= few) {
            std::transform(spare + first, spare + first + size, order + first, position);
        } else {
            sort_bucket(spare + first, size, shift, keys + first, order + first);
        }
    };
    // A small object far from the light has all its rays in one bucket.
    if (count > rays_per_chunk) {
        tbb::parallel_for(std::size_t{0}, digit_values, sort_part);
    } else {
        for (std::size_t value = 0; value < digit_values; ++value) sort_part(value);
    }
}

}  // namespace

const SortedRays& RaySort::sort(const RayBatch& rays, const OcclusionBatch* only) {
    if (rays.size() > RayKey::position_mask) throw std::length_error("2^29 rays or more in one batch");
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    // Rays that are wanted lie together: chunks of as many rays are not as much work.
    const std::size_t most_chunks = std::max<std::size_t>(threads, 8);
    chunks_.resize(std::clamp<std::size_t>(rays.size() / rays_per_chunk, 1, most_chunks));
    sorted_.framed.resize(rays.common_direction ? 0 : rays.size());
    keys_.resize(rays.size());

    key_and_count(rays, only);
    scatter();
    sort_buckets();
    for (std::size_t face = 0; face <= face_count; ++face) {
        sorted_.face_begin[face] = bucket_begin_[face << RayKey::bucket_bits];
    }
    return sorted_;
}

std::size_t RaySort::chunk_begin(std::size_t chunk) const {
    if (chunk == chunks_.size()) return keys_.size();
    return keys_.size() * chunk / chunks_.size() / rays_per_step * rays_per_step;
}

std::span<const std::uint64_t> RaySort::keys_of(std::size_t chunk) const {
    return {keys_.data() + chunk_begin(chunk), chunks_[chunk].key_count};
}

void RaySort::key_and_count(const RayBatch& rays, const OcclusionBatch* only) {
    const KeyMap map = key_map(sampled_bounds(rays, only));
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t c) {
        const std::size_t begin = chunk_begin(c);
        Chunk& chunk = chunks_[c];
        chunk.key_count = frame_and_key(rays, begin, chunk_begin(c + 1), only, map, sorted_.framed.data(),
                                        keys_.data() + begin);
        chunk.next.fill(0);
        for (const std::uint64_t key : keys_of(c)) ++chunk.next[RayKey::bucket(key)];
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
    in_buckets_.resize(sum);
    sorted_.order.resize(sum);
    tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t c) {
        Histogram& next = chunks_[c].next;
        for (const std::uint64_t key : keys_of(c)) in_buckets_[next[RayKey::bucket(key)]++] = key;
    });
}

void RaySort::sort_buckets() {
    std::uint64_t* const spare = keys_.data();
    tbb::parallel_for(std::size_t{0}, RayKey::bucket_count, [&](std::size_t bucket) {
        const std::size_t begin = bucket_begin_[bucket];
        sort_bucket(in_buckets_.data() + begin, bucket_begin_[bucket + 1] - begin,
                    RayKey::position_bits + RayKey::rest_bits, spare + begin, sorted_.order.data() + begin);
    });
}

}  // namespace gridreel::traversal
