#include "tools/gallery/gait.h"
#include "tools/gallery/marble_simulation.h"
#include "tools/gallery/travelling_wave.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

using namespace gridreel::gallery;

namespace {

/// Where a joint is, by walking down the skeleton, with the figure's way forward added.
glm::dvec3 joint_in_world(std::size_t joint, double phase) {
    const auto& rest = rest_joints();
    const WalkPose pose = walk(phase);
    std::vector<std::size_t> chain{joint};
    while (chain.back() != hips) chain.push_back(rest[chain.back()].parent);

    glm::dvec3 position = pose.hips_position + glm::dvec3(stride_m * phase, 0.0, 0.0);
    glm::dquat rotation = pose.local_rotation[hips];
    for (std::size_t i = chain.size() - 1; i-- > 0;) {
        position += rotation * (rest[chain[i]].position - rest[chain[i + 1]].position);
        rotation = rotation * pose.local_rotation[chain[i]];
    }
    return position;
}

}  // namespace

TEST_CASE("a walker's standing foot stays where it is", "[gallery]") {
    // Flat on the floor from 0.1 to 0.3 of its own cycle, the other foot half a cycle later.
    for (const auto& [joint, shift] : {std::pair{toes_right, 0.0}, std::pair{toes_left, 0.5}}) {
        const glm::dvec3 planted = joint_in_world(joint, 0.1 + shift);
        CHECK(planted.y == Approx(rest_joints()[joint].position.y).margin(1e-3));
        for (double phase = 0.1; phase <= 0.3; phase += 0.02)
            CHECK(glm::length(joint_in_world(joint, phase + shift) - planted) < 2e-3);
    }
}

TEST_CASE("a walker's foot rolls over its ball before it leaves, and never sinks in", "[gallery]") {
    const glm::dvec3 planted = joint_in_world(toes_right, 0.2);
    CHECK(glm::length(joint_in_world(toes_right, 0.6) - planted) < 0.03);
    CHECK(joint_in_world(foot_right, 0.6).y > joint_in_world(foot_right, 0.2).y + 0.05);
    for (double phase = 0.0; phase < 1.0; phase += 0.01) CHECK(joint_in_world(toes_right, phase).y > 0.015);
}

TEST_CASE("a walker's cycle closes, and its halves mirror each other", "[gallery]") {
    const WalkPose first = walk(0.0), last = walk(1.0);
    CHECK(glm::length(first.hips_position - last.hips_position) < 1e-12);
    for (std::size_t joint = 0; joint < joint_count; ++joint)
        CHECK(std::abs(glm::dot(first.local_rotation[joint], last.local_rotation[joint])) == Approx(1.0));

    const glm::dvec3 right = joint_in_world(hand_right, 0.3), left = joint_in_world(hand_left, 0.8);
    CHECK(left.x - right.x == Approx(0.5 * stride_m).margin(1e-6));
    CHECK(left.y == Approx(right.y).margin(1e-6));
    CHECK(left.z == Approx(-right.z).margin(1e-6));
}

TEST_CASE("marbles come to rest in the bowl and do not run into each other", "[gallery]") {
    const MarbleRun run;
    const auto keys = simulate(run, Bowl{});
    REQUIRE(keys.size() == 121);
    REQUIRE(keys.front().size() == run.marble_count);

    const auto& last = keys.back();
    const auto& before = keys[keys.size() - 2];
    for (std::size_t i = 0; i < last.size(); ++i) {
        INFO(i);
        CHECK(last[i].position.y > 0.98 * run.radius_m);
        CHECK(last[i].position.y < 1.5);
        CHECK(glm::length(last[i].position - before[i].position) < 0.01);
        CHECK(glm::length(last[i].rotation) == Approx(1.0));
        for (std::size_t j = 0; j < i; ++j)
            CHECK(glm::length(last[i].position - last[j].position) > 0.98 * 2.0 * run.radius_m);
    }
}

TEST_CASE("one marble falls as gravity says, until it lands", "[gallery]") {
    // From the mouth at 2.7 m it leaves at 2.2 m/s: after t, 2.7 - 2.2 t - 4.905 t².
    const MarbleRun run{.marble_count = 1, .duration_s = 0.25, .feed_speed_m_per_s = 2.2};
    const auto keys = simulate({.marble_count = 1, .duration_s = 0.25}, Bowl{});
    const double start = keys[0][0].position.y;
    CHECK(start == Approx(run.mouth_height_m - 1.0));
    const double t = 6.0 / 24.0;
    CHECK(keys[6][0].position.y == Approx(start - 2.2 * t - 4.905 * t * t).margin(2e-3));
}

TEST_CASE("a ball dropped into the middle of the bowl ends at its lowest point", "[gallery]") {
    const Bowl bowl;
    const auto keys = simulate({.marble_count = 1, .duration_s = 30.0}, bowl);
    const glm::dvec3 end = keys.back().front().position;
    const double lowest = bowl.lift_m + bowl.half_thickness_m + 0.1;
    CHECK(end.y == Approx(lowest).margin(0.002));
    CHECK(std::hypot(end.x, end.z) < 0.06);
}

TEST_CASE("wave weights are cosine and sine, with their slopes as tangents", "[gallery]") {
    Document document;
    const std::array<int, 1> cycles{1};
    add_wave_weights(document, 0, cycles, 2.0, 4);
    const Channel& channel = document.channels.front();
    const Accessor& accessor = document.accessors[channel.values];
    // Five keys of in-tangents, values and out-tangents of two weights.
    REQUIRE(accessor.count == 5 * 3 * 2);
    std::vector<float> values(accessor.count);
    std::memcpy(values.data(), accessor.bytes.data(), accessor.bytes.size());

    // A quarter into the clip of 2 s: cos = 0, sin = 1; slopes -pi and 0 per second.
    const std::array<float, 6> key({values[6], values[7], values[8], values[9], values[10], values[11]});
    CHECK(key[0] == Approx(-3.14159265));
    CHECK(key[1] == Approx(0.0).margin(1e-6));
    CHECK(key[2] == Approx(0.0).margin(1e-6));
    CHECK(key[3] == Approx(1.0));
    CHECK(key[4] == key[0]);
    CHECK(key[5] == key[1]);
    CHECK(document.accessors[channel.times].max.front() == 2.0);
}
