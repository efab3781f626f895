#include "engine/still_triangles.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace gridreel::engine {
namespace {

/// Parts of so many triangles, that move or do not.
anim::FrameGeometry geometry_of(const std::vector<std::pair<std::size_t, bool>>& parts) {
    anim::FrameGeometry geometry;
    for (const auto& [triangles, moves] : parts) {
        anim::Part part;
        part.first_triangle = geometry.triangles.size();
        part.triangle_count = triangles;
        part.moves = moves;
        geometry.parts.push_back(part);
        geometry.triangles.resize(geometry.triangles.size() + triangles);
    }
    return geometry;
}

}  // namespace

TEST_CASE("triangles of parts that do not move stand still", "[engine]") {
    const auto still = find_still(
        geometry_of({{3, false}, {2, true}, {4, false}, {0, true}, {1, false}, {0, false}, {5, true}}));
    REQUIRE(still);
    CHECK(still->count() == 15);
    CHECK(std::vector(still->runs().begin(), still->runs().end()) ==
          std::vector<rebuild::TriangleRun>{{0, 3}, {5, 10}});
}

TEST_CASE("nothing is said of clips in which everything moves", "[engine]") {
    CHECK_FALSE(find_still(geometry_of({{3, true}, {2, true}})));
    CHECK_FALSE(find_still(geometry_of({})));
    CHECK_FALSE(find_still(geometry_of({{3, true}, {0, false}})));
}

}  // namespace gridreel::engine
