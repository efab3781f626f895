#include "traversal/radix_sort.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace gridreel::traversal {
namespace {

using Item = std::uint64_t;  // key << 32 | what it belongs to
constexpr unsigned key_shift = 32;

constexpr unsigned bucket_bits = 11;
constexpr std::size_t bucket_count = std::size_t{1} << bucket_bits;
constexpr std::size_t items_per_chunk = 1 << 13;  // fewer are not worth a thread
using Histogram = std::array<std::uint32_t, bucket_count>;

constexpr unsigned digit_bits = 8;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;
constexpr std::size_t few_items = 32;  // sooner sorted by insertion than counted

/// Scatters the items by the bits of their keys from `shift` on. @return where each bucket begins, and the
/// end
std::array<std::uint32_t, bucket_count + 1> scatter_to_buckets(const rebuild::Buffer<Item>& from,
                                                               rebuild::Buffer<Item>& to, unsigned shift) {
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    std::vector<Histogram> next(std::clamp<std::size_t>(from.size() / items_per_chunk, 1, threads));
    const auto begin_of = [&](std::size_t chunk) { return from.size() * chunk / next.size(); };

    tbb::parallel_for(std::size_t{0}, next.size(), [&](std::size_t chunk) {
        next[chunk].fill(0);
        for (std::size_t i = begin_of(chunk); i < begin_of(chunk + 1); ++i) ++next[chunk][from[i] >> shift];
    });
    // Prefix sum over buckets, and within a bucket over chunks: equal keys keep their order.
    std::array<std::uint32_t, bucket_count + 1> begin;
    std::uint32_t sum = 0;
    for (std::size_t bucket = 0; bucket < bucket_count; ++bucket) {
        begin[bucket] = sum;
        for (Histogram& histogram : next) sum += std::exchange(histogram[bucket], sum);
    }
    begin[bucket_count] = sum;
    tbb::parallel_for(std::size_t{0}, next.size(), [&](std::size_t chunk) {
        for (std::size_t i = begin_of(chunk); i < begin_of(chunk + 1); ++i) {
            to[next[chunk][from[i] >> shift]++] = from[i];
        }
    });
    return begin;
}

void sort_by_digit(const Item* from, Item* to, std::size_t count, unsigned shift) {
    const auto digit = [shift](Item item) { return item >> shift & (digit_values - 1); };
    std::array<std::uint32_t, digit_values> next{};
    for (std::size_t i = 0; i < count; ++i) ++next[digit(from[i])];
    std::uint32_t sum = 0;
    for (std::uint32_t& value : next) sum += std::exchange(value, sum);
    for (std::size_t i = 0; i < count; ++i) to[next[digit(from[i])]++] = from[i];
}

void sort_by_insertion(Item* items, std::size_t count) {
    for (std::size_t i = 1; i < count; ++i) {
        const Item item = items[i];
        std::size_t place = i;
        for (; place > 0 && items[place - 1] >> key_shift > item >> key_shift; --place) {
            items[place] = items[place - 1];
        }
        items[place] = item;
    }
}

}  // namespace

void radix_sort(rebuild::Buffer<Item>& items, rebuild::Buffer<Item>& scratch, unsigned key_bits) {
    scratch.resize(items.size());
    const unsigned low_bits = key_bits - std::min(key_bits, bucket_bits);
    const auto begin = scatter_to_buckets(items, scratch, key_shift + low_bits);

    // What is left of a bucket is sorted from its last digit on, to and fro between the two buffers.
    const unsigned passes = (low_bits + digit_bits - 1) / digit_bits;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, bucket_count, 8), [&](const auto& buckets) {
        for (std::size_t bucket = buckets.begin(); bucket < buckets.end(); ++bucket) {
            const std::size_t count = begin[bucket + 1] - begin[bucket];
            Item* from = scratch.data() + begin[bucket];
            Item* to = items.data() + begin[bucket];
            if (count < few_items) {
                sort_by_insertion(from, count);
                if (passes % 2 == 1) std::copy_n(from, count, to);
                continue;
            }
            for (unsigned pass = 0; pass < passes; ++pass) {
                sort_by_digit(from, to, count, key_shift + pass * digit_bits);
                std::swap(from, to);
            }
        }
    });
    if (passes % 2 == 0) std::swap(items, scratch);
}

}  // namespace gridreel::traversal
