#include "engine/fitting_view.h"

#include <glm/geometric.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace gridreel;

namespace {

/// How far out the box's farthest corner lies: 1 at the picture's edge, negative if one is behind the eye.
double fill(const engine::View& view, const glm::dvec3& low, const glm::dvec3& high) {
    double largest = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point{(corner & 1) ? high.x : low.x, (corner & 2) ? high.y : low.y,
                               (corner & 4) ? high.z : low.z};
        const double depth = view.depth(point);
        if (depth <= 0.0) return -1.0;
        const glm::dvec3 arm = (point - view.eye) / depth;
        largest = std::max({largest, std::abs(glm::dot(arm, view.right)) / view.half_width,
                            std::abs(glm::dot(arm, view.up)) / view.half_height});
    }
    return largest;
}

}  // namespace

TEST_CASE("the fitted camera sees all of the box and comes as near as the margin allows", "[engine]") {
    const double scale = GENERATE(1e-3, 1.0, 1e6);
    const glm::dvec3 low = scale * glm::dvec3{-1.0, 0.0, 2.0};
    const auto [width, height] = GENERATE(std::pair{1280, 720}, std::pair{300, 900});
    const glm::dvec3 high = low + scale * GENERATE(glm::dvec3{1.0, 2.0, 0.5}, glm::dvec3{30.0, 0.0, 30.0},
                                                   glm::dvec3{0.0, 5.0, 0.0});
    const engine::View view = engine::fitting_view(low, high, width, height);
    CHECK(fill(view, low, high) == Approx(0.95).epsilon(1e-6));
}

TEST_CASE("the fitted camera looks from the front, right and above", "[engine]") {
    const engine::View view = engine::fitting_view({-1, -1, -1}, {1, 1, 1}, 100, 100);
    CHECK(view.eye.z > view.eye.x);
    CHECK(view.eye.x > 0.0);
    CHECK(view.eye.y > 0.0);
    CHECK(view.up.y > 0.9);
    CHECK(glm::dot(view.forward, glm::normalize(-view.eye)) == Approx(1.0));
}

TEST_CASE("a point is seen from one metre", "[engine]") {
    const engine::View view = engine::fitting_view({4, 5, 6}, {4, 5, 6}, 100, 100);
    CHECK(glm::distance(view.eye, glm::dvec3(4, 5, 6)) == Approx(1.0));
}
