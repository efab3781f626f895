#include "traversal/hilbert_curve.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <cstdlib>
#include <vector>

namespace gridreel::tests {

using traversal::hilbert_length;
using traversal::hilbert_place;
using traversal::hilbert_side;

TEST_CASE("Hilbert's curve visits every cell, each beside the one before", "[traversal]") {
    constexpr std::uint32_t nowhere = hilbert_length;
    std::vector<std::uint32_t> cells(hilbert_length, nowhere);
    for (std::uint32_t y = 0; y < hilbert_side; ++y) {
        for (std::uint32_t x = 0; x < hilbert_side; ++x) {
            const std::uint32_t place = hilbert_place(x, y);
            if (place >= hilbert_length || cells[place] != nowhere) FAIL(x << ", " << y << " at " << place);
            cells[place] = y * hilbert_side + x;
        }
    }
    CHECK(cells.front() == 0);
    CHECK(cells.back() == hilbert_side - 1);
    for (std::uint32_t place = 1; place < hilbert_length; ++place) {
        const auto x = [&](std::uint32_t at) { return static_cast<int>(cells[at] % hilbert_side); };
        const auto y = [&](std::uint32_t at) { return static_cast<int>(cells[at] / hilbert_side); };
        const int steps = std::abs(x(place) - x(place - 1)) + std::abs(y(place) - y(place - 1));
        if (steps != 1) FAIL("a step of " << steps << " to " << place);
    }
}

}  // namespace gridreel::tests
