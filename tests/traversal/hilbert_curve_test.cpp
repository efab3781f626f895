#include "traversal/hilbert_curve.h"
#include "test_triangles.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <cstdlib>
#include <vector>

namespace gridreel::tests {

namespace {

constexpr unsigned levels = 12;
constexpr std::uint32_t side = 1u << levels;
constexpr std::uint32_t length = side * side;

}  // namespace

TEST_CASE("Hilbert's curve visits every cell, each beside the one before", "[traversal]") {
    constexpr std::uint32_t nowhere = length;
    std::vector<std::uint32_t> cells(length, nowhere);
    for (std::uint32_t y = 0; y < side; ++y) {
        for (std::uint32_t x = 0; x < side; ++x) {
            const std::uint32_t place = traversal::hilbert_index<levels>(x, y);
            if (place >= length || cells[place] != nowhere) FAIL(x << ", " << y << " at " << place);
            cells[place] = y * side + x;
        }
    }
    CHECK(cells.front() == 0);
    CHECK(cells.back() == side - 1);
    for (std::uint32_t place = 1; place < length; ++place) {
        const auto x = [&](std::uint32_t at) { return static_cast<int>(cells[at] % side); };
        const auto y = [&](std::uint32_t at) { return static_cast<int>(cells[at] / side); };
        const int steps = std::abs(x(place) - x(place - 1)) + std::abs(y(place) - y(place - 1));
        if (steps != 1) FAIL("a step of " << steps << " to " << place);
    }
}

TEST_CASE("a finer Hilbert curve runs through the cells of a coarser one in their order", "[traversal]") {
    constexpr unsigned finest = 16;
    const auto at = [](std::uint32_t x, std::uint32_t y) { return traversal::hilbert_index<finest>(x, y); };
    Random random(63);
    const auto any = [&] { return random.next() % (1u << finest); };
    int strange = 0;
    for (int i = 0; i < 100'000; ++i) {
        const std::uint32_t x = any(), y = any();
        constexpr unsigned below = finest - levels;
        strange += at(x, y) >> 2 * below != traversal::hilbert_index<levels>(x >> below, y >> below);
    }
    CHECK(strange == 0);
    CHECK(at(0, 0) == 0);
    CHECK(at(65535, 0) == 0xffffffffu);
}

}  // namespace gridreel::tests
