#include "traversal/radix_sort.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace gridreel::traversal {
namespace {

constexpr unsigned digit_bits = 11;
constexpr std::size_t digit_values = std::size_t{1} << digit_bits;
constexpr std::size_t items_per_chunk = 1 << 13;  // fewer are not worth a thread
using Histogram = std::array<std::uint32_t, digit_values>;

std::size_t digit(std::uint64_t item, unsigned shift) {
    return item >> shift & (digit_values - 1);
}

void sort_by_digit(const rebuild::Buffer<std::uint64_t>& from, rebuild::Buffer<std::uint64_t>& to,
                   unsigned shift, std::vector<Histogram>& next) {
    const std::size_t chunks = next.size();
    const auto begin_of = [&](std::size_t chunk) { return from.size() * chunk / chunks; };

    // Count.
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        next[chunk].fill(0);
        for (std::size_t i = begin_of(chunk); i < begin_of(chunk + 1); ++i)
            ++next[chunk][digit(from[i], shift)];
    });
    // Prefix sum over digits, and within a digit over chunks: equal digits keep their order.
    std::uint32_t sum = 0;
    for (std::size_t value = 0; value < digit_values; ++value) {
        for (Histogram& histogram : next) sum += std::exchange(histogram[value], sum);
    }
    // Scatter.
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        for (std::size_t i = begin_of(chunk); i < begin_of(chunk + 1); ++i) {
            to[next[chunk][digit(from[i], shift)]++] = from[i];
        }
    });
}

}  // namespace

void radix_sort(rebuild::Buffer<std::uint64_t>& items, rebuild::Buffer<std::uint64_t>& scratch,
                unsigned key_bits) {
    scratch.resize(items.size());
    const auto threads = static_cast<std::size_t>(std::max(1, tbb::this_task_arena::max_concurrency()));
    std::vector<Histogram> next(std::clamp<std::size_t>(items.size() / items_per_chunk, 1, threads));
    for (unsigned bit = 0; bit < key_bits; bit += digit_bits) {
        sort_by_digit(items, scratch, 32 + bit, next);
        std::swap(items, scratch);
    }
}

}  // namespace gridreel::traversal
