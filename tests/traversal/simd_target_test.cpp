#include "traversal/simd_target.h"

#include <catch2/catch.hpp>

namespace gridreel::traversal {

TEST_CASE("the SIMD target can be limited and set free again", "[traversal][simd]") {
    const auto best = simd_target();
    const auto all = simd_targets();
    REQUIRE_FALSE(all.empty());
    CHECK(all.front() == best);
    for (const auto target : all) {
        CHECK(limit_simd_target(target));
        CHECK(simd_target() == target);
    }
    CHECK_FALSE(limit_simd_target("MMX"));
    CHECK(simd_target() == all.back());
    CHECK(limit_simd_target(""));
    CHECK(simd_target() == best);
    CHECK(simd_targets() == all);
}

}  // namespace gridreel::traversal
