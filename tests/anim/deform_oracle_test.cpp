// Pose and deform against the slow evaluator in double, on random scenes at random times.

#include "anim/box.h"
#include "anim/frame_geometry.h"

#include "double_oracle.h"
#include "random_scene.h"
#include "scene_builder.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace gridreel::anim {
namespace {

using testing::distance;
using testing::OracleVertex;

constexpr double times_s[]{-1.0, 0.0, 0.21, 0.5, 0.77, 1.13, 1.6, 1.999, 5.0};

double diagonal_of(const FrameGeometry& frame) {
    Box box;
    for (const glm::vec3& position : frame.positions) box.extend(position);
    return glm::distance(glm::dvec3{box.min}, glm::dvec3{box.max});
}

/// Largest error of any position, as a share of the frame's diagonal.
double position_error(const FrameGeometry& frame, const std::vector<OracleVertex>& exact) {
    double worst = 0.0;
    for (std::size_t v = 0; v < exact.size(); ++v) {
        worst = std::max(worst, distance(glm::dvec3{frame.positions[v]}, exact[v].position));
    }
    return worst / diagonal_of(frame);
}

TEST_CASE("frames of random scenes match the evaluation in double", "[anim]") {
    const std::uint32_t seed = GENERATE(range(1u, 61u));
    const Scene scene = testing::random_scene(seed);
    const Clip clip = choose_clip(scene, "all");
    FrameGeometry frame = lay_out(scene, clip);

    std::size_t directions = 0;
    std::size_t well_conditioned = 0;
    for (const double time_s : times_s) {
        CAPTURE(seed, time_s);
        deform(scene, pose(scene, clip, time_s), frame);
        const std::vector<OracleVertex> exact = testing::oracle_vertices(scene, clip, time_s);
        REQUIRE(exact.size() == frame.positions.size());
        CHECK(position_error(frame, exact) < 1e-6);

        // Normals and tangents: as exact as floats can be where a blend of joints nearly flattens space.
        double worst_normal = 0.0;
        double worst_tangent = 0.0;
        for (std::size_t v = 0; v < exact.size(); ++v) {
            const double normal_error = distance(glm::dvec3{frame.normals[v]}, exact[v].normal);
            worst_normal = std::max(worst_normal, normal_error / exact[v].normal_condition);
            if (exact[v].normal == glm::dvec3{0.0}) continue;
            ++directions;
            if (exact[v].normal_condition < 1e3) ++well_conditioned;
            if (frame.tangents.empty()) continue;
            const glm::vec4 tangent = frame.tangents[v];
            const double tangent_error = distance(glm::dvec3{tangent}, glm::dvec3{exact[v].tangent});
            worst_tangent = std::max(worst_tangent, tangent_error / exact[v].tangent_condition);
            // Which way a frame is turned is only certain where space is not nearly flattened.
            if (exact[v].normal_condition < 1e3) CHECK(double(tangent.w) == exact[v].tangent.w);
        }
        CHECK(worst_normal < 1e-6);
        CHECK(worst_tangent < 1e-6);
    }
    CHECK(well_conditioned * 10 >= directions * 8);
}

TEST_CASE("parts of many runs of vertices match the evaluation in double", "[anim]") {
    const std::uint32_t seed = GENERATE(range(200u, 203u));
    const Scene scene = testing::random_scene(seed, {.vertices_per_part = 2 * longest_run + 100});
    const Clip clip = choose_clip(scene, "all");
    FrameGeometry frame = lay_out(scene, clip);
    deform(scene, pose(scene, clip, 0.8), frame);

    CHECK(position_error(frame, testing::oracle_vertices(scene, clip, 0.8)) < 1e-6);
}

TEST_CASE("frames far from the origin match the evaluation in double", "[anim]") {
    // A kilometre away a float is off by up to 3e-5 m, whatever one does.
    const std::uint32_t seed = GENERATE(range(100u, 110u));
    const Scene scene = testing::random_scene(seed, {.offset = 1000.0});
    const Clip clip = choose_clip(scene, "all");
    FrameGeometry frame = lay_out(scene, clip);

    for (const double time_s : times_s) {
        CAPTURE(seed, time_s);
        deform(scene, pose(scene, clip, time_s), frame);
        CHECK(position_error(frame, testing::oracle_vertices(scene, clip, time_s)) < 1e-5);
    }
}

}  // namespace
}  // namespace gridreel::anim
