#include "rebuild/cell_mapping.h"

#include <catch2/catch.hpp>

#include <limits>

namespace gridreel::rebuild {
namespace {

const Bounds3 world{.min = {-1, 0, 0}, .max = {3, 2, 1}};
const CellMapping mapping(world, {4, 2, 1});

CellRange of(const glm::vec3& low, const glm::vec3& high) {
    return mapping.cells_of(low, high, low);
}

}  // namespace

TEST_CASE("a box is listed in the cells it overlaps", "[rebuild]") {
    CHECK(of({-0.9f, 0.1f, 0.1f}, {-0.1f, 0.9f, 0.9f}) == CellRange{.first = {0, 0, 0}, .last = {0, 0, 0}});
    CHECK(of({-0.5f, 0.1f, 0.0f}, {1.5f, 1.9f, 1.0f}) == CellRange{.first = {0, 0, 0}, .last = {2, 1, 0}});
    CHECK(of({-0.5f, 0.1f, 0.0f}, {1.5f, 1.9f, 1.0f}).cell_count() == 6);
}

TEST_CASE("a box that touches a plane between cells is listed on both sides", "[rebuild]") {
    CHECK(of({0.0f, 0.5f, 0.5f}, {0.5f, 1.0f, 0.5f}) == CellRange{.first = {0, 0, 0}, .last = {1, 1, 0}});
}

TEST_CASE("what lies outside the world is listed at its border", "[rebuild]") {
    CHECK(of({-50.0f, -50.0f, -50.0f}, {-40.0f, 50.0f, 1e11f}) ==
          CellRange{.first = {0, 0, 0}, .last = {0, 1, 0}});
}

TEST_CASE("a corner that is not traceable leaves no cells", "[rebuild]") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {nan, infinity, -infinity, 2e12f}) {
        CHECK(mapping.cells_of({0, 0, bad}, {1, 1, 1}, {1, 0, 0}).cell_count() == 0);
        CHECK(mapping.cells_of({1, 1, 1}, {bad, 0, 0}, {1, 0, 0}).cell_count() == 0);
        CHECK(mapping.cells_of({1, 1, 1}, {0, 0, 0}, {1, bad, 0}).cell_count() == 0);
    }
}

}  // namespace gridreel::rebuild
