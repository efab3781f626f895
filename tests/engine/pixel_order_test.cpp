#include "engine/pixel_order.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

using namespace gridreel;
using engine::Pixel;

TEST_CASE("every pixel is visited once, also in pictures that cut tiles", "[engine]") {
    const auto [width, height] =
        GENERATE(std::pair{1, 1}, std::pair{16, 16}, std::pair{33, 47}, std::pair{7, 100});
    const std::vector<Pixel> order = engine::pixel_order(width, height);
    REQUIRE(order.size() == static_cast<std::size_t>(width * height));
    std::set<std::pair<int, int>> seen;
    for (const Pixel pixel : order) {
        CHECK((pixel.x < width && pixel.y < height));
        seen.emplace(pixel.x, pixel.y);
    }
    CHECK(seen.size() == order.size());
}

TEST_CASE("4, 16 and 256 pixels in a row form squares", "[engine]") {
    const std::vector<Pixel> order = engine::pixel_order(64, 48);
    const auto [count, side] = GENERATE(std::pair<std::size_t, int>{4, 2}, std::pair<std::size_t, int>{16, 4},
                                        std::pair<std::size_t, int>{256, 16});
    for (std::size_t first = 0; first < order.size(); first += count) {
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = begin + static_cast<std::ptrdiff_t>(count);
        const auto [left, right] =
            std::minmax_element(begin, end, [](Pixel a, Pixel b) { return a.x < b.x; });
        const auto [top, bottom] =
            std::minmax_element(begin, end, [](Pixel a, Pixel b) { return a.y < b.y; });
        CHECK(right->x - left->x == side - 1);
        CHECK(bottom->y - top->y == side - 1);
    }
}

TEST_CASE("the walk begins with the Z of Morton order", "[engine]") {
    const std::vector<Pixel> order = engine::pixel_order(16, 16);
    CHECK(order[0] == Pixel{0, 0});
    CHECK(order[1] == Pixel{1, 0});
    CHECK(order[2] == Pixel{0, 1});
    CHECK(order[3] == Pixel{1, 1});
    CHECK(order[4] == Pixel{2, 0});
}
