#include "rebuild/resolution.h"

#include <catch2/catch.hpp>

#include <stdexcept>

namespace gridreel::rebuild {

TEST_CASE("a cube gets the cube root of lambda N cells an axis", "[rebuild]") {
    const Bounds3 cube{.min = glm::vec3{-1.0f}, .max = glm::vec3{1.0f}};
    CHECK(choose_resolution(cube, 1000, {.lambda = 1.0f}) == glm::ivec3{10});
    CHECK(choose_resolution(cube, 1000, {.lambda = 8.0f}) == glm::ivec3{20});
}

TEST_CASE("cells are as near to cubes as whole numbers allow", "[rebuild]") {
    const Bounds3 box{.min = {0, 0, 0}, .max = {8, 2, 4}};
    // 64 cubes a unit of volume is 4 an axis.
    CHECK(choose_resolution(box, 64 * 64, {.lambda = 1.0f}) == glm::ivec3{32, 8, 16});
}

TEST_CASE("a flat scene gets one cell on its flat axis and the rule in two dimensions", "[rebuild]") {
    const Bounds3 floor{.min = {0, 0, 0}, .max = {10, 0, 10}};
    CHECK(choose_resolution(floor, 10'000, {.lambda = 1.0f}) == glm::ivec3{100, 1, 100});
    const Bounds3 wire{.min = {0, 0, 0}, .max = {0, 5, 0}};
    CHECK(choose_resolution(wire, 300, {.lambda = 1.0f}) == glm::ivec3{1, 300, 1});
}

TEST_CASE("nothing to put into cells gets one cell", "[rebuild]") {
    CHECK(choose_resolution({}, 1000) == glm::ivec3{1});
    CHECK(choose_resolution({.min = glm::vec3{0.0f}, .max = glm::vec3{1.0f}}, 0) == glm::ivec3{1});
    CHECK(choose_resolution({.min = glm::vec3{3.0f}, .max = glm::vec3{3.0f}}, 10) == glm::ivec3{1});
}

TEST_CASE("the limits hold on boxes of any shape and size", "[rebuild]") {
    const ResolutionPolicy policy{.lambda = 50.0f, .max_cells_per_axis = 300, .max_cells = 100'000};
    for (const float x : {1e-20f, 1.0f, 1e12f}) {
        for (const float y : {0.0f, 1e-7f, 1.0f, 1e9f}) {
            const auto cells =
                choose_resolution({.min = glm::vec3{0.0f}, .max = {x, y, 1.0f}}, 1'000'000, policy);
            CHECK(cells.x >= 1);
            CHECK(cells.y >= 1);
            CHECK(cells.z >= 1);
            CHECK(cells.x <= 300);
            CHECK(cells.y <= 300);
            CHECK(cells.z <= 300);
            CHECK(double(cells.x) * cells.y * cells.z <= 100'000.0);
        }
    }
}

TEST_CASE("a policy out of its ranges is refused", "[rebuild]") {
    const Bounds3 cube{.min = glm::vec3{0.0f}, .max = glm::vec3{1.0f}};
    CHECK_THROWS_AS(choose_resolution(cube, 1, {.lambda = 0.0f}), std::invalid_argument);
    CHECK_THROWS_AS(choose_resolution(cube, 1, {.lambda = std::numeric_limits<float>::infinity()}),
                    std::invalid_argument);
    CHECK_THROWS_AS(choose_resolution(cube, 1, {.max_cells_per_axis = 0}), std::invalid_argument);
    CHECK_THROWS_AS(choose_resolution(cube, 1, {.max_cells_per_axis = 65'536}), std::invalid_argument);
    CHECK_THROWS_AS(choose_resolution(cube, 1, {.max_cells = 0}), std::invalid_argument);
}

}  // namespace gridreel::rebuild
