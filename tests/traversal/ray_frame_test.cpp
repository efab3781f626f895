#include "traversal/ray_frame.h"

#include <catch2/catch.hpp>

#include <limits>

namespace gridreel::traversal {

TEST_CASE("a ray's frame follows its longest axis", "[traversal]") {
    const RayFrame ray = ray_frame({1.0f, -4.0f, 2.0f}, 0.5f, 3.0f);
    CHECK(ray.axes == Axes{.k = 1, .negative = true});
    CHECK(ray.axes.u() == 2);
    CHECK(ray.axes.v() == 0);
    CHECK(ray.slope_u == 0.5f);
    CHECK(ray.slope_v == 0.25f);
    CHECK(ray.depth_min == 2.0f);
    CHECK(ray.depth_max == 12.0f);
    CHECK(ray.t_of(6.0f) == 1.5f);
}

TEST_CASE("faces of the cube of directions go back and forth", "[traversal]") {
    for (unsigned face = 0; face < face_count; ++face) CHECK(axes_of_face(face).face() == face);
}

TEST_CASE("a ray without a direction or an interval hits nothing", "[traversal]") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    CHECK_FALSE(ray_frame({0.0f, 0.0f, 1e-30f}, 0.0f, infinity).hits_nothing());
    CHECK(ray_frame({0.0f, 0.0f, 0.0f}, 0.0f, 1.0f).hits_nothing());
    CHECK(ray_frame({nan, 0.0f, 1.0f}, 0.0f, 1.0f).hits_nothing());
    CHECK(ray_frame({infinity, 0.0f, 1.0f}, 0.0f, 1.0f).hits_nothing());
    CHECK(ray_frame({0.0f, 0.0f, 1.0f}, 1.0f, 1.0f).hits_nothing());
    CHECK(ray_frame({0.0f, 0.0f, 1.0f}, nan, 1.0f).hits_nothing());
}

}  // namespace gridreel::traversal
