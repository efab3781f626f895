// Parallel loops in an arena that three threads share; with any argument the bodies race for one counter.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <cstdlib>
#include <functional>
#include <thread>
#include <vector>

namespace {

constexpr int size = 5'000;

/// Writes, doubles in parallel, sums in parallel: every step reads what other threads wrote in the one
/// before.
long sum_of_doubles(bool race) {
    std::vector<int> values(size, 1);
    int counter = 0;
    tbb::parallel_for(
        0, size,
        [&](int i) {
            values[std::size_t(i)] *= 2;
            if (race) ++counter;
        },
        tbb::static_partitioner{});
    tbb::parallel_for(0, size / 100, [&](int row) {
        tbb::parallel_for(0, 100, [&](int i) { values[std::size_t(100 * row + i)] += 1; });
    });
    for (int& value : values) value -= 1;
    return tbb::parallel_deterministic_reduce(
        tbb::blocked_range<int>(0, size, 64), 0L,
        [&](const tbb::blocked_range<int>& range, long sum) {
            for (int i = range.begin(); i < range.end(); ++i) sum += values[std::size_t(i)];
            return sum;
        },
        std::plus<>{});
}

}  // namespace

int main(int argc, char**) {
    tbb::task_arena arena(2);
    std::vector<long> sums(3, 0);
    std::vector<std::thread> threads;
    for (long& sum : sums) {
        threads.emplace_back([&, argc] {
            for (int round = 0; round < 100; ++round) {
                sum += arena.execute([&] { return sum_of_doubles(argc > 1); });
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    return sums == std::vector<long>(3, 100L * 2 * size) ? EXIT_SUCCESS : EXIT_FAILURE;
}
