// The edge functions, which all tracers share, against the textbook in double precision.

#include "reference_intersection.h"
#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <glm/geometric.hpp>

#include <cmath>

namespace gridreel::tests {
namespace {

using traversal::HitBatch;
using traversal::make_tracer;
using traversal::RayBatch;
using traversal::TracerKind;

HitBatch naive_hits(const Triangles& triangles, const RayBatch& rays) {
    const auto tracer = make_tracer({.kind = TracerKind::naive, .resolution = {}});
    tracer->rebuild(triangles.view());
    HitBatch hits;
    tracer->closest_hits(rays, hits);
    return hits;
}

/// Rays whose answer is beyond doubt in double precision must get it in single precision.
void check_clear_hits(const Triangles& triangles, const RayBatch& rays) {
    const HitBatch hits = naive_hits(triangles, rays);
    std::size_t clear = 0, wrong = 0, imprecise = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 origin{rays.origin_of(i)}, direction{rays.direction_of(i)};
        // In doubt: any triangle nearly grazed, or nearly missed.
        std::optional<ReferenceHit> nearest;
        bool doubtful = false;
        for (std::uint32_t t = 0; t < triangles.triangles.size(); ++t) {
            const auto hit = intersect(triangles, t, origin, direction);
            if (!hit || hit->inside < -1e-3) continue;
            doubtful |= std::fabs(hit->inside) < 1e-3 || hit->facing < 1e-3;
            if (hit->inside >= 0.0 && (!nearest || hit->t < nearest->t)) nearest = hit;
        }
        if (doubtful) continue;
        ++clear;
        const bool hit = hits.triangle[i] != traversal::no_triangle;
        if (hit != nearest.has_value()) {
            ++wrong;
        } else if (nearest) {
            // A few roundings, magnified where the triangle is seen at a low angle.
            imprecise += std::fabs(double(hits.t[i]) / nearest->t - 1.0) > 5e-7 / nearest->facing;
        }
    }
    CHECK(clear > rays.size() / 4);
    CHECK(wrong == 0);
    CHECK(imprecise == 0);
}

}  // namespace

TEST_CASE("clear hits and misses agree with the textbook in double precision", "[traversal][reference]") {
    const glm::vec3 eye{0.4f, 0.9f, 2.5f};
    for (const Triangles& triangles : {soup(300, 0.3f), sheet(12), boxes(3), sphere(10)}) {
        INFO(triangles.name);
        check_clear_hits(triangles, pinhole(eye, {0.1f, 0.0f, 0.0f}, 0.6f, 64));
        check_clear_hits(triangles, from_point({0.31f, 0.17f, 0.23f}, 4000, 31));
    }
}

TEST_CASE("scenes so small that products of coordinates leave the range of floats are hit, too",
          "[traversal][reference]") {
    constexpr float scale = 1e-11f;
    const Triangles triangles = scaled(soup(300, 0.3f), scale, {});
    check_clear_hits(triangles, from_point(glm::vec3{0.31f, 0.17f, 0.23f} * scale, 4000, 33));
}

TEST_CASE("triangles far smaller than their distance are not lost", "[traversal][reference]") {
    // A million-triangle sheet seen from afar has triangles of this size: aim at the middle of each.
    const Triangles triangles = scaled(sheet(40), 1e-3f, {0.5f, -0.25f, 0.125f});
    const glm::vec3 eye{2.0f, 3.0f, 4.0f};
    RayBatch rays;
    rays.resize(triangles.triangles.size(), eye, traversal::RayOrder::arbitrary);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::uvec3& t = triangles.triangles[i];
        rays.set_direction(
            i, (triangles.positions[t.x] + triangles.positions[t.y] + triangles.positions[t.z]) / 3.0f - eye);
        rays.t_min[i] = 0.0f;
        rays.t_max[i] = 2.0f;
    }
    const HitBatch hits = naive_hits(triangles, rays);
    std::size_t missed = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) missed += hits.triangle[i] == traversal::no_triangle;
    CHECK(missed == 0);
}

TEST_CASE("a triangle is hit from a hair's breadth above it", "[traversal][reference]") {
    // On which side of its plane such an origin is, single precision cannot tell, all the less if the
    // triangle is a strip that runs away from it.
    Random random(51);
    for (const float width : {1.0f, 1e-2f, 1e-3f}) {
        for (const float height : {1e-4f, 1e-5f, 2e-6f}) {
            std::size_t aimed = 0, missed = 0;
            for (int i = 0; i < 2000; ++i) {
                const glm::vec3 along = random.on_sphere();
                const glm::vec3 across = glm::normalize(glm::cross(along, random.on_sphere()));
                const glm::vec3 start = random.in_box(-1.0f, 1.0f);
                Triangles strip;
                strip.add(start, start + along + width * across, start + along - width * across);
                // From above one point to as far below another: through the plane half way.
                const glm::vec3 lift = height * glm::cross(along, across);
                RayBatch rays;
                const glm::vec3 origin = start + 0.9f * along + lift;
                rays.resize(1, origin, traversal::RayOrder::arbitrary);
                rays.set_direction(0, start + 0.2f * along - lift - origin);
                rays.t_min[0] = 0.0f;
                rays.t_max[0] = 1.0f;
                const auto hit =
                    intersect(strip, 0, glm::dvec3{rays.origin_of(0)}, glm::dvec3{rays.direction_of(0)});
                if (!hit || hit->inside < 0.1 || hit->t < 0.25 || hit->t > 0.75) continue;
                ++aimed;
                missed += naive_hits(strip, rays).triangle[0] == traversal::no_triangle;
            }
            INFO("width " << width << ", height " << height);
            CHECK(aimed > 1000);
            CHECK(missed == 0);
        }
    }
}

}  // namespace gridreel::tests
