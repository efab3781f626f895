#include "tools/gallery/gait.h"

#include "tools/gallery/turns.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>

namespace gridreel::gallery {

namespace {

constexpr double stance = 0.62;  ///< part of the cycle that a foot is on the floor
constexpr double heel_strike_turn = 0.055, toe_off_turn = -0.15;  ///< pitch of the foot, toes up positive
constexpr double first_ankle_x =
    0.315;  ///< ankle ahead of the moving frame, were the foot flat at heel strike

glm::dquat about(const glm::dvec3& axis, double turns) {
    const double s = sin_turns(0.5 * turns);
    return {cos_turns(0.5 * turns), s * axis.x, s * axis.y, s * axis.z};
}

// Facing +x: pitching the toes up or swinging a limb forward turns about +z.
glm::dquat pitch(double turns) {
    return about({0.0, 0.0, 1.0}, turns);
}
glm::dquat yaw(double turns) {
    return about({0.0, 1.0, 0.0}, turns);
}
glm::dquat roll(double turns) {
    return about({1.0, 0.0, 0.0}, turns);
}

/// The rotation that brings two orthogonal directions onto two others.
glm::dquat turn_frame(const glm::dvec3& from_x, const glm::dvec3& from_z, const glm::dvec3& to_x,
                      const glm::dvec3& to_z) {
    const glm::dmat3 from(from_x, glm::cross(from_z, from_x), from_z), to(to_x, glm::cross(to_z, to_x), to_z);
    return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

// --- Feet ----------------------------------------------------------------------------------------

struct FootPose {
    glm::dvec3 ankle;    ///< z as at rest
    double pitch = 0.0;  ///< turns
    double toes = 0.0;   ///< turns, relative to the foot
};

/// While it stands: rolls over the heel, lies flat, rolls over the ball.
FootPose standing_foot(double part_of_cycle) {
    const auto& rest = rest_joints();
    const glm::dvec3 ankle = rest[foot_right].position, ball = rest[toes_right].position;
    const double lowered = glm::smoothstep(0.0, 0.09, part_of_cycle);
    const double raised =
        glm::smoothstep(0.30, stance + 0.10, part_of_cycle) / glm::smoothstep(0.30, stance + 0.10, stance);

    FootPose foot{.ankle = {first_ankle_x - stride_m * part_of_cycle, ankle.y, ankle.z}};
    foot.pitch = heel_strike_turn * (1.0 - lowered) + toe_off_turn * raised;
    foot.toes = -toe_off_turn * raised;
    // The point that stays on the floor: the heel's underside or the ball's.
    const glm::dvec3 pivot =
        foot.pitch > 0.0 ? glm::dvec3(-0.06, -ankle.y, 0.0) : glm::dvec3(ball.x - ankle.x, -ankle.y, 0.0);
    foot.ankle += pivot - pitch(foot.pitch) * pivot;
    return foot;
}

/// Cubic between two values with given slopes.
double hermite(double from, double from_slope, double to, double to_slope, double t) {
    const double u = 1.0 - t;
    return u * u * (1.0 + 2.0 * t) * from + u * u * t * from_slope + t * t * (1.0 + 2.0 * u) * to -
           t * t * u * to_slope;
}

FootPose foot_at(double phase) {
    phase -= std::floor(phase);
    if (phase <= stance) return standing_foot(phase);

    // Through the air, leaving and landing at the speed of the standing foot.
    constexpr double small = 1e-4;
    const double air = 1.0 - stance, t = (phase - stance) / air;
    const FootPose leave = standing_foot(stance), before = standing_foot(stance - small);
    const FootPose land = standing_foot(0.0), after = standing_foot(small);
    const auto fly = [&](double from, double earlier, double to, double later) {
        return hermite(from, (from - earlier) / small * air, to, (later - to) / small * air, t);
    };
    FootPose foot{.ankle = leave.ankle};
    foot.ankle.x = fly(leave.ankle.x, before.ankle.x, land.ankle.x, after.ankle.x);
    foot.ankle.y =
        hermite(leave.ankle.y, (leave.ankle.y - before.ankle.y) / small * air * 0.5, land.ankle.y, -0.1, t);
    foot.pitch = glm::mix(leave.pitch, land.pitch, glm::smoothstep(0.0, 0.85, t));
    foot.toes = leave.toes * (1.0 - glm::smoothstep(0.0, 0.45, t));
    return foot;
}

// --- Limbs ---------------------------------------------------------------------------------------

/// World rotations of thigh and shin that bring the ankle to its place, knee forward.
void reach(const glm::dvec3& hip, const glm::dvec3& ankle, const glm::dvec3& forward, glm::dquat& thigh,
           glm::dquat& shin) {
    const auto& rest = rest_joints();
    const double upper = glm::length(rest[shin_right].position - rest[thigh_right].position);
    const double lower = glm::length(rest[foot_right].position - rest[shin_right].position);
    const glm::dvec3 way = ankle - hip;
    const double length = std::min(glm::length(way), 0.9995 * (upper + lower));
    const glm::dvec3 down = glm::normalize(way);

    // The knee, by the law of cosines, in the plane of `down` and `forward`.
    const double along = (upper * upper - lower * lower + length * length) / (2.0 * length);
    const double out = std::sqrt(std::max(0.0, upper * upper - along * along));
    const glm::dvec3 side = glm::normalize(glm::cross(forward, -down));
    const glm::dvec3 ahead = glm::cross(-down, side);
    const glm::dvec3 knee = hip + along * down + out * ahead;

    const auto point_down = [&](const glm::dvec3& to) {
        const glm::dvec3 up = -glm::normalize(to);
        return turn_frame({0, 1, 0}, {0, 0, 1}, up, side);
    };
    thigh = point_down(knee - hip);
    shin = point_down(hip + length * down - knee);
}

}  // namespace

WalkPose walk(double phase) {
    const auto& rest = rest_joints();
    std::array<glm::dquat, joint_count> world;
    WalkPose pose;

    // Trunk. Lowest when both feet are down, and over the standing leg when only one is.
    const double two_steps = 2.0 * phase;
    pose.hips_position = rest[hips].position + glm::dvec3(0.008 * sin_turns(two_steps),
                                                          -0.034 - 0.017 * cos_turns(two_steps - 0.1),
                                                          0.02 * sin_turns(phase));
    world[hips] = yaw(0.018 * cos_turns(phase)) * roll(-0.010 * sin_turns(phase + 0.05)) * pitch(-0.008);
    world[spine] = yaw(0.002 * cos_turns(phase)) * roll(0.002 * sin_turns(phase)) * pitch(-0.010);
    world[chest] = yaw(-0.020 * cos_turns(phase)) * roll(0.004 * sin_turns(phase)) * pitch(-0.012);
    world[neck] = yaw(-0.006 * cos_turns(phase)) * pitch(-0.014 + 0.003 * cos_turns(two_steps));
    world[head] = pitch(-0.004 + 0.003 * cos_turns(two_steps - 0.15));

    for (const bool is_left : {false, true}) {
        const std::size_t step = is_left ? side_step : 0;
        const double mirror = is_left ? -1.0 : 1.0;
        const double own_phase = phase + (is_left ? 0.5 : 0.0);

        // Leg.
        const FootPose foot = foot_at(own_phase);
        const glm::dvec3 hip =
            pose.hips_position + world[hips] * (rest[thigh_right + step].position - rest[hips].position);
        const glm::dvec3 ankle(foot.ankle.x, foot.ankle.y, 0.78 * mirror * foot.ankle.z);
        const glm::dvec3 toes_out = glm::normalize(glm::dvec3(1.0, 0.0, 0.10 * mirror));
        reach(hip, ankle, toes_out, world[thigh_right + step], world[shin_right + step]);
        const glm::dquat heading = yaw(-0.016 * mirror);
        world[foot_right + step] = heading * pitch(foot.pitch);
        world[toes_right + step] = heading * pitch(foot.pitch + foot.toes);

        // Arm: hangs from the shoulder, swings against its leg, elbow and hand follow late.
        const auto hang = [&](const glm::dvec3& at_rest, double outward) {
            const glm::dvec3 from = -glm::normalize(at_rest);
            const glm::dvec3 to = glm::normalize(glm::dvec3(0.0, 1.0, -mirror * outward));
            const glm::dvec3 ahead = glm::normalize(glm::dvec3(1.0, 0.0, 0.0) - from.x * from);
            return turn_frame(from, glm::cross(ahead, from), to, glm::cross(glm::dvec3(1, 0, 0), to));
        };
        const double swing = -0.062 * cos_turns(own_phase) + 0.006;
        const double bend = 0.055 + 0.032 * (0.5 - 0.5 * cos_turns(own_phase - 0.06));
        const glm::dvec3 upper = rest[forearm_right + step].position - rest[upper_arm_right + step].position;
        const glm::dvec3 lower = rest[hand_right + step].position - rest[forearm_right + step].position;
        const glm::dquat from_chest = yaw(-0.012 * cos_turns(phase));
        world[upper_arm_right + step] = from_chest * pitch(swing) * hang(upper, 0.20);
        world[forearm_right + step] = from_chest * pitch(swing + bend) * hang(lower, 0.10);
        world[hand_right + step] = from_chest * pitch(swing + 1.15 * bend) * hang(lower, 0.04);
    }

    for (std::size_t joint = 0; joint < joint_count; ++joint)
        pose.local_rotation[joint] =
            joint == hips ? world[joint] : glm::inverse(world[rest[joint].parent]) * world[joint];
    return pose;
}

}  // namespace gridreel::gallery
