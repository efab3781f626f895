#include "engine/compact.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <vector>

using namespace gridreel;

TEST_CASE("the marked indices come out ascending, across blocks", "[engine]") {
    const std::size_t count =
        GENERATE(std::size_t{0}, std::size_t{1}, std::size_t{16384}, std::size_t{100'003});
    rebuild::Buffer<std::uint8_t> marks;
    marks.resize(count);
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < count; ++i) {
        marks[i] = (i * i) % 7 == 2 ? 1 : 0;
        if (marks[i] != 0) expected.push_back(static_cast<std::uint32_t>(i));
    }
    rebuild::Buffer<std::uint32_t> indices;
    engine::compact(marks, indices);
    CHECK(std::vector<std::uint32_t>(indices.begin(), indices.end()) == expected);
}
