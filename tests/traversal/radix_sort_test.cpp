#include "traversal/radix_sort.h"
#include "test_triangles.h"

#include <catch2/catch.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

namespace gridreel::tests {

TEST_CASE("radix sort is std::stable_sort by key, on any number of threads", "[traversal]") {
    for (const std::size_t count : {0u, 1u, 20u, 1000u, 100'000u}) {
        for (const std::uint32_t used_bits : {~0u, 0x3ffu, 1u << 30}) {
            for (const unsigned key_bits : {0u, 3u, 11u, 31u, 32u}) {
                for (const int threads : {1, 3}) {
                    Random random(41);
                    rebuild::Buffer<std::uint64_t> items, scratch;
                    items.resize(count);
                    for (std::size_t i = 0; i < count; ++i) {
                        const std::uint64_t key =
                            key_bits == 0 ? 0 : random.next() >> (32 - key_bits) & used_bits;
                        items[i] = key << 32 | static_cast<std::uint32_t>(random.next());
                    }
                    std::vector<std::uint64_t> expected(items.begin(), items.end());
                    std::stable_sort(expected.begin(), expected.end(),
                                     [](std::uint64_t a, std::uint64_t b) { return a >> 32 < b >> 32; });
                    tbb::task_arena(threads).execute(
                        [&] { traversal::radix_sort(items, scratch, key_bits); });
                    CHECK(std::equal(expected.begin(), expected.end(), items.begin(), items.end()));
                }
            }
        }
    }
}

}  // namespace gridreel::tests
