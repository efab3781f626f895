#include "tools/gallery/figure.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gridreel::gallery {

namespace {

// Mirror images of the right side.
constexpr glm::dvec3 mirrored(const glm::dvec3& p) {
    return {p.x, p.y, -p.z};
}

constexpr glm::dvec3 shoulder{-0.01, 1.415, 0.185}, elbow{-0.02, 1.195, 0.33}, wrist{0.015, 1.005, 0.455};
constexpr glm::dvec3 hip{0.0, 0.93, 0.092}, knee{0.0, 0.51, 0.092}, ankle{0.0, 0.09, 0.092},
    ball{0.135, 0.03, 0.1};

/// A ball that slides from one place to another and changes its size on the way.
struct Part {
    Joint joint;
    glm::dvec3 from, to;
    double from_radius, to_radius;
    glm::dvec3 color;  ///< linear RGB
};

constexpr glm::dvec3 skin{0.72, 0.42, 0.27}, hair{0.09, 0.035, 0.02}, shirt{0.80, 0.26, 0.06},
    trousers{0.05, 0.10, 0.22}, shoes{0.75, 0.72, 0.66};

constexpr std::array<Part, 10> trunk{
    {{hips, {0.0, 0.965, -0.065}, {0.0, 0.965, 0.065}, 0.112, 0.112, trousers},
     {spine, {0.0, 1.04, 0.0}, {0.0, 1.16, 0.0}, 0.108, 0.112, shirt},
     {chest, {0.005, 1.21, -0.04}, {0.005, 1.21, 0.04}, 0.112, 0.112, shirt},
     {chest, {0.0, 1.32, -0.065}, {0.0, 1.32, 0.065}, 0.108, 0.108, shirt},
     {chest, {-0.01, 1.41, -0.14}, {-0.01, 1.41, 0.14}, 0.062, 0.062, shirt},
     {neck, {0.0, 1.47, 0.0}, {0.01, 1.56, 0.0}, 0.052, 0.048, skin},
     {head, {0.035, 1.625, 0.0}, {0.035, 1.64, 0.0}, 0.076, 0.08, skin},
     {head, {0.02, 1.69, 0.0}, {0.025, 1.70, 0.0}, 0.1, 0.1, skin},
     {head, {0.118, 1.668, 0.0}, {0.125, 1.652, 0.0}, 0.012, 0.018, skin},
     {head, {-0.02, 1.70, 0.0}, {0.005, 1.735, 0.0}, 0.1, 0.104, hair}}};

constexpr std::array<Part, 4> right_arm{
    {{upper_arm_right, shoulder, elbow, 0.058, 0.043, shirt},
     {forearm_right, elbow, wrist, 0.043, 0.03, skin},
     {hand_right, {0.02, 0.975, 0.475}, {0.035, 0.925, 0.505}, 0.036, 0.03, skin},
     {hand_right, {0.035, 0.98, 0.47}, {0.075, 0.94, 0.485}, 0.019, 0.015, skin}}};

constexpr std::array<Part, 6> right_leg{
    {{thigh_right, hip, knee, 0.092, 0.06, trousers},
     {shin_right, knee, {-0.012, 0.40, 0.092}, 0.058, 0.059, trousers},
     {shin_right, {-0.012, 0.40, 0.092}, ankle, 0.059, 0.04, trousers},
     {foot_right, ankle, ball, 0.042, 0.031, shoes},
     {foot_right, {-0.045, 0.04, 0.092}, {0.05, 0.036, 0.097}, 0.039, 0.036, shoes},
     {toes_right, ball, {0.195, 0.027, 0.104}, 0.03, 0.026, shoes}}};

/// Signed distance of a part (Quilez' "round cone"): the larger ball, the smaller one, or the cone between.
double distance(const Part& part, const glm::dvec3& p) {
    const glm::dvec3 axis = part.to - part.from, out = p - part.from;
    const double length_2 = glm::dot(axis, axis), shrink = part.from_radius - part.to_radius;
    const double side_2 = length_2 - shrink * shrink;
    const double along = glm::dot(out, axis), beyond = along - length_2;
    const glm::dvec3 off = out * length_2 - axis * along;
    const double off_2 = glm::dot(off, off);
    const double along_2 = along * along * length_2, beyond_2 = beyond * beyond * length_2;
    const double steep = (shrink > 0.0 ? 1.0 : shrink < 0.0 ? -1.0 : 0.0) * shrink * shrink * off_2;
    if ((beyond > 0.0 ? 1.0 : -1.0) * side_2 * beyond_2 > steep)
        return std::sqrt(off_2 + beyond_2) / length_2 - part.to_radius;
    if ((along > 0.0 ? 1.0 : -1.0) * side_2 * along_2 < steep)
        return std::sqrt(off_2 + along_2) / length_2 - part.from_radius;
    return (std::sqrt(off_2 * side_2 / length_2) + along * shrink) / length_2 - part.from_radius;
}

/// A union whose seams are filled out over `blend` metres (Quilez' polynomial smooth minimum).
double smooth_union(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - 0.25 * blend * h * h;
}

template <std::size_t n>
double distance(const std::array<Part, n>& limb, const glm::dvec3& p, double blend) {
    double nearest = distance(limb[0], p);
    for (std::size_t i = 1; i < n; ++i) nearest = smooth_union(nearest, distance(limb[i], p), blend);
    return nearest;
}

/// A ball around a limb: a union with a limb farther away than its blend changes nothing.
struct Ball {
    glm::dvec3 centre;
    double radius;

    [[nodiscard]] double distance(const glm::dvec3& p) const { return glm::length(p - centre) - radius; }
};
constexpr Ball arm_ball{{0.01, 1.19, 0.34}, 0.36}, leg_ball{{0.03, 0.5, 0.09}, 0.56};

/// The head's parts are smaller, so their seams are narrower.
double body(const glm::dvec3& p) {
    double whole = distance(trunk, p, p.y > 1.55 ? 0.03 : 0.06 - 0.03 * glm::smoothstep(1.47, 1.55, p.y));
    constexpr double blend = 0.045;
    for (const glm::dvec3& q : {p, mirrored(p)}) {
        if (arm_ball.distance(q) < whole + blend)
            whole = smooth_union(whole, distance(right_arm, q, 0.02), blend);
        if (leg_ball.distance(q) < whole + blend)
            whole = smooth_union(whole, distance(right_leg, q, 0.03), blend);
    }
    return whole;
}

/// Calls `visit(part, joint, distance)` for every part of the body, left limbs with their own joints.
template <typename Visit>
void for_each_part(const glm::dvec3& p, Visit&& visit) {
    for (const Part& part : trunk) visit(part, std::size_t{part.joint}, distance(part, p));
    const auto visit_limb = [&](const auto& limb) {
        for (const Part& part : limb) {
            visit(part, std::size_t{part.joint}, distance(part, p));
            visit(part, part.joint + side_step, distance(part, mirrored(p)));
        }
    };
    visit_limb(right_arm);
    visit_limb(right_leg);
}

// --- Skin ----------------------------------------------------------------------------------------

using JointShares = std::array<double, joint_count>;

/// Falls from 1 at the nearest part to 0 at those `reach` metres farther away.
double nearness(double distance, double nearest, double reach) {
    const double near = std::max(0.0, 1.0 - (distance - nearest) / reach);
    return near * near;
}

/// Shares that sum to 1, by the distance of every joint's own parts of the body.
JointShares joint_shares(const glm::dvec3& p) {
    JointShares distances;
    distances.fill(std::numeric_limits<double>::infinity());
    for_each_part(p, [&](const Part&, std::size_t joint, double d) {
        distances[joint] = std::min(distances[joint], d);
    });

    const double nearest = *std::ranges::min_element(distances);
    JointShares shares;
    std::ranges::transform(distances, shares.begin(), [&](double d) { return nearness(d, nearest, 0.07); });
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) share /= sum;
    return shares;
}

/// The nearest part's colour; clothes meet in narrow seams.
glm::dvec3 color_at(const glm::dvec3& p) {
    double nearest = std::numeric_limits<double>::infinity();
    for_each_part(p, [&](const Part&, std::size_t, double d) { nearest = std::min(nearest, d); });
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    for_each_part(p, [&](const Part& part, std::size_t, double d) {
        const double near = nearness(d, nearest, 0.008);
        sum += near * part.color;
        weight += near;
    });
    return sum / weight;
}

/// The four largest shares as 16-bit weights.
void pack_weights(const JointShares& share, glm::u8vec4& joints, glm::u16vec4& weights) {
    std::array<std::size_t, joint_count> order;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t joint) { return share[joint]; });

    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += share[order[std::size_t(i)]];
    int left = 65535;
    for (int i = 3; i >= 0; --i) {
        const std::size_t joint = order[std::size_t(i)];
        const int weight = i == 0 ? left : static_cast<int>(65535.0 * share[joint] / sum);
        left -= weight;
        weights[i] = static_cast<std::uint16_t>(weight);
        joints[i] = static_cast<std::uint8_t>(weight == 0 ? 0 : joint);
    }
}

}  // namespace

const std::array<JointRest, joint_count>& rest_joints() {
    static constexpr std::array<JointRest, joint_count> rest{{{"hips", hips, {0.0, 0.95, 0.0}},
                                                              {"spine", hips, {0.0, 1.06, 0.0}},
                                                              {"chest", spine, {0.0, 1.20, 0.0}},
                                                              {"neck", chest, {-0.005, 1.46, 0.0}},
                                                              {"head", neck, {0.0, 1.57, 0.0}},
                                                              {"upper_arm.R", chest, shoulder},
                                                              {"forearm.R", upper_arm_right, elbow},
                                                              {"hand.R", forearm_right, wrist},
                                                              {"thigh.R", hips, hip},
                                                              {"shin.R", thigh_right, knee},
                                                              {"foot.R", shin_right, ankle},
                                                              {"toes.R", foot_right, ball},
                                                              {"upper_arm.L", chest, mirrored(shoulder)},
                                                              {"forearm.L", upper_arm_left, mirrored(elbow)},
                                                              {"hand.L", forearm_left, mirrored(wrist)},
                                                              {"thigh.L", hips, mirrored(hip)},
                                                              {"shin.L", thigh_left, mirrored(knee)},
                                                              {"foot.L", shin_left, mirrored(ankle)},
                                                              {"toes.L", foot_left, mirrored(ball)}}};
    return rest;
}

SkinnedShape make_figure(std::size_t triangles) {
    const Solid solid{.distance = body, .low = {-0.2, -0.03, -0.6}, .high = {0.3, 1.85, 0.6}};
    SkinnedShape figure{.shape = polygonise_to_count(solid, triangles, 0.12)};
    const std::size_t vertex_count = figure.shape.positions.size();
    figure.joints.resize(vertex_count);
    figure.weights.resize(vertex_count);
    figure.shape.colors.resize(vertex_count);
    tbb::parallel_for(std::size_t{0}, vertex_count, [&](std::size_t vertex) {
        const glm::dvec3 p(figure.shape.positions[vertex]);
        pack_weights(joint_shares(p), figure.joints[vertex], figure.weights[vertex]);
        figure.shape.colors[vertex] = color_bytes(color_at(p));
    });
    return figure;
}

}  // namespace gridreel::gallery
