#include "traversal/ray_sort.h"
#include "test_rays.h"
#include "test_triangles.h"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace gridreel::tests {
namespace {

using traversal::ray_frame;
using traversal::RayBatch;
using traversal::RaySort;
using traversal::SortedRays;

std::vector<std::uint32_t> order_of(const RayBatch& rays, int threads) {
    RaySort sort;
    tbb::task_arena arena(threads);
    return arena.execute([&] {
        const SortedRays& sorted = sort.sort(rays);
        return std::vector<std::uint32_t>(sorted.order.begin(), sorted.order.end());
    });
}

/// Rays to all sides, some of which hit nothing.
RayBatch all_sides(std::size_t count) {
    RayBatch rays = from_point({0.1f, 0.2f, 0.3f}, count, 61);
    for (std::size_t i = 0; i < count; i += 7) rays.t_max[i] = 0.0f;
    for (std::size_t i = 3; i < count; i += 70) {
        rays.set_direction(i, glm::vec3{std::numeric_limits<float>::quiet_NaN()});
    }
    return rays;
}

/// A sun's rays, some of which hit nothing.
RayBatch sun(std::size_t count) {
    RayBatch rays = from_surfaces({0.3f, -1.0f, 0.2f}, soup(1000, 0.1f), count);
    for (std::size_t i = 0; i < count; i += 7) rays.t_max[i] = 0.0f;
    for (std::size_t i = 3; i < count; i += 70) rays.set_origin(i, {0.0f, 2e12f, 0.0f});
    return rays;
}

/// Mean distance between the slopes of rays that follow each other.
double step(const RayBatch& rays, const std::vector<std::uint32_t>& order) {
    double sum = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i) {
        const auto a = ray_frame(rays, order[i - 1]), b = ray_frame(rays, order[i]);
        sum += std::hypot(a.slope_u - b.slope_u, a.slope_v - b.slope_v);
    }
    return sum / double(order.size() - 1);
}

/// How many rays stand elsewhere than they would if every one stood in the order once.
std::size_t missing(const SortedRays& sorted) {
    std::vector<std::uint32_t> seen(sorted.order.begin(), sorted.order.end());
    std::sort(seen.begin(), seen.end());
    std::size_t strange = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) strange += seen[i] != i;
    return strange;
}

}  // namespace

TEST_CASE("sorting keeps every ray, face by face, and frames it", "[traversal]") {
    for (const std::size_t count : {0u, 1u, 15u, 16u, 17u, 5000u, 100'001u}) {
        INFO(count << " rays");
        const RayBatch rays = all_sides(count);
        RaySort sort;
        const SortedRays& sorted = sort.sort(rays);
        REQUIRE(sorted.order.size() == count);
        std::size_t strange = missing(sorted);
        for (unsigned face = 0; face <= traversal::face_count; ++face) {
            const std::size_t end =
                face == traversal::face_count ? count : std::size_t(sorted.face_begin[face + 1]);
            for (std::size_t place = sorted.face_begin[face]; place < end; ++place) {
                const std::uint32_t ray = sorted.order[place];
                const auto frame = ray_frame(rays, ray);
                const traversal::FramedRay& framed = sorted.framed[ray];
                if (frame.hits_nothing()) {
                    strange += face != traversal::face_count;
                } else {
                    strange += face != frame.axes.face() || framed.slope_u != frame.slope_u ||
                               framed.slope_v != frame.slope_v || framed.depth_min != frame.depth_min ||
                               framed.depth_max != frame.depth_max;
                }
            }
        }
        CHECK(strange == 0);
    }
}

TEST_CASE("sorting parallel rays keeps every one, those that hit nothing last", "[traversal]") {
    for (const std::size_t count : {0u, 1u, 15u, 16u, 17u, 5000u, 100'001u}) {
        INFO(count << " rays");
        const RayBatch rays = sun(count);
        RaySort sort;
        const SortedRays& sorted = sort.sort(rays);
        REQUIRE(sorted.order.size() == count);
        std::size_t strange = missing(sorted);
        const unsigned down = traversal::Axes{.k = 1, .negative = true}.face();
        const std::size_t dead = sorted.face_begin[traversal::face_count];
        for (std::size_t place = 0; place < count; ++place) {
            const std::uint32_t ray = sorted.order[place];
            const bool hits_nothing = ray % 7 == 0 || ray % 70 == 3;
            strange += hits_nothing != (place >= dead);
        }
        CHECK(strange == 0);
        CHECK(sorted.face_begin[down] == 0);
        CHECK(sorted.face_begin[down + 1] == dead);
    }
}

TEST_CASE("parallel rays that follow each other are neighbours", "[traversal]") {
    const RayBatch rays = from_surfaces({0.3f, -1.0f, 0.2f}, soup(1000, 0.1f), 100'000);
    RaySort sort;
    const SortedRays& sorted = sort.sort(rays);
    double sum = 0.0;
    for (std::size_t i = 1; i < rays.size(); ++i) {
        // Across the direction: what lies along it does not count.
        const glm::vec3 way = rays.origin_of(sorted.order[i]) - rays.origin_of(sorted.order[i - 1]);
        sum += double(glm::length(glm::cross(way, glm::normalize(*rays.common_direction))));
    }
    // A place each on some 2 x 2 metres: a hundred thousand in a row are 0.006 apart.
    CHECK(sum / double(rays.size()) < 0.015);
}

TEST_CASE("the order of sorted rays does not depend on the number of threads", "[traversal]") {
    for (const RayBatch& rays : {all_sides(150'000), sun(150'000)}) {
        const std::vector<std::uint32_t> alone = order_of(rays, 1);
        CHECK(order_of(rays, 2) == alone);
        CHECK(order_of(rays, 5) == alone);
    }
}

TEST_CASE("sorted rays that follow each other point alike", "[traversal]") {
    // Spread evenly, and most of them in one spot, as from a far light.
    for (const float spot : {1.0f, 1e-3f}) {
        constexpr std::size_t count = 90'000;
        Random random(62);
        RayBatch rays;
        rays.resize(count, glm::vec3{0.0f}, traversal::RayOrder::arbitrary);
        for (std::size_t i = 0; i < count; ++i) {
            const float size = i % 10 == 0 ? 1.0f : spot;
            rays.set_direction(i,
                               {random.uniform(-0.5f, 0.5f) * size, random.uniform(-0.5f, 0.5f) * size, 1});
            rays.t_min[i] = 0.0f;
            rays.t_max[i] = 1.0f;
        }
        // Evenly spread points are so far apart; the spot is smaller than the cells of its bucket.
        const double apart =
            spot == 1.0f ? 1.0 / std::sqrt(double(count)) : 0.1 / std::sqrt(0.1 * count) + 0.9 * spot;
        CHECK(step(rays, order_of(rays, 2)) < 4.0 * apart);
    }
}

}  // namespace gridreel::tests
