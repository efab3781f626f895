#include "engine/compact.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace gridreel::engine {

void compact(const rebuild::Buffer<std::uint8_t>& marks, rebuild::Buffer<std::uint32_t>& indices) {
    constexpr std::size_t block_size = 16384;
    const std::size_t blocks = (marks.size() + block_size - 1) / block_size;
    const auto end_of = [&](std::size_t block) { return std::min((block + 1) * block_size, marks.size()); };

    // Count by block; the sums before each block are where it writes.
    std::vector<std::size_t> first(blocks + 1, 0);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        first[block + 1] = static_cast<std::size_t>(
            std::count_if(marks.begin() + block * block_size, marks.begin() + end_of(block),
                          [](std::uint8_t mark) { return mark != 0; }));
    });
    std::inclusive_scan(first.begin(), first.end(), first.begin());

    // Write.
    indices.resize(first.back());
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        std::size_t next = first[block];
        for (std::size_t i = block * block_size; i < end_of(block); ++i) {
            if (marks[i] != 0) indices[next++] = static_cast<std::uint32_t>(i);
        }
    });
}

}  // namespace gridreel::engine
