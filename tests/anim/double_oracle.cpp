#include "double_oracle.h"

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <optional>

namespace gridreel::anim::testing {
namespace {

using Values = std::vector<double>;

/// `width` numbers of a key: of a cubic key its in-tangent (0), value (1) or out-tangent (2).
Values key_values(const Sampler& sampler, std::size_t key, std::size_t block) {
    const bool cubic = sampler.interpolation == Interpolation::cubic_spline;
    const std::size_t first = (cubic ? 3 * key + block : key) * sampler.width;
    const auto begin = sampler.values.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + sampler.width};
}

Values mix(const Values& a, const Values& b, double u) {
    Values mixed;
    for (std::size_t i = 0; i < a.size(); ++i) mixed.push_back((1.0 - u) * a[i] + u * b[i]);
    return mixed;
}

Values ahead(const Values& from, const Values& tangent, double time_s) {
    Values result;
    for (std::size_t i = 0; i < from.size(); ++i) result.push_back(from[i] + tangent[i] * time_s);
    return result;
}

/// A Hermite segment as the Bezier curve it is, by de Casteljau's construction.
Values spline(const Sampler& sampler, std::size_t key, double u, double interval_s) {
    const Values a = key_values(sampler, key, 1);
    const Values d = key_values(sampler, key + 1, 1);
    const Values b = ahead(a, key_values(sampler, key, 2), interval_s / 3.0);
    const Values c = ahead(d, key_values(sampler, key + 1, 0), -interval_s / 3.0);
    const Values ab = mix(a, b, u), bc = mix(b, c, u), cd = mix(c, d, u);
    return mix(mix(ab, bc, u), mix(bc, cd, u), u);
}

glm::dquat quaternion(const Values& v) {
    return {v[3], v[0], v[1], v[2]};
}

/// From `a`, a share of the turn that leads from `a` to `b`, about that turn's own axis. For unit keys.
Values part_of_turn(const Values& a, const Values& b, double u) {
    const glm::dquat from = glm::normalize(quaternion(a));
    glm::dquat turn = glm::inverse(from) * glm::normalize(quaternion(b));
    if (turn.w < 0.0) turn = -turn;
    const glm::dvec3 axis{turn.x, turn.y, turn.z};
    const double half_angle = std::atan2(glm::length(axis), turn.w);
    if (half_angle == 0.0) return a;
    const glm::dquat there = from * glm::angleAxis(2.0 * half_angle * u, glm::normalize(axis));
    return {there.x, there.y, there.z, there.w};
}

Values sampled(const Sampler& sampler, ChannelPath path, double time_s) {
    const auto& times = sampler.times_s;
    if (time_s <= double(times.front())) return key_values(sampler, 0, 1);
    for (std::size_t key = 0; key + 1 < times.size(); ++key) {
        const double begin = double(times[key]), end = double(times[key + 1]);
        if (time_s < begin || time_s >= end) continue;
        const double u = (time_s - begin) / (end - begin);
        const Values a = key_values(sampler, key, 1);
        if (sampler.interpolation == Interpolation::step) return a;
        if (sampler.interpolation == Interpolation::cubic_spline) {
            return spline(sampler, key, u, end - begin);
        }
        const Values b = key_values(sampler, key + 1, 1);
        return path == ChannelPath::rotation ? part_of_turn(a, b, u) : mix(a, b, u);
    }
    return key_values(sampler, times.size() - 1, 1);
}

std::optional<Values> animated(const Scene& scene, const Clip& clip, Index node, ChannelPath path,
                               double time_s) {
    std::optional<Values> last;
    for (const Index animation : clip.animations) {
        for (const Channel& channel : scene.animations[animation].channels) {
            if (channel.object != node || channel.path != path) continue;
            last = sampled(scene.animations[animation].samplers[channel.sampler], path, time_s);
        }
    }
    return last;
}

glm::dmat4 local_of(const Trs& trs) {
    const glm::dmat4 one{1.0};
    return glm::translate(one, trs.translation) * glm::mat4_cast(glm::normalize(trs.rotation)) *
           glm::scale(one, trs.scale);
}

glm::dmat4 world_of(const Scene& scene, const Clip& clip, Index index, double time_s) {
    const Node& node = scene.nodes[index];
    glm::dvec3 translation = node.trs.translation;
    glm::dquat rotation = node.trs.rotation;
    glm::dvec3 scale = node.trs.scale;
    if (const auto v = animated(scene, clip, index, ChannelPath::translation, time_s)) {
        translation = {(*v)[0], (*v)[1], (*v)[2]};
    }
    if (const auto v = animated(scene, clip, index, ChannelPath::rotation, time_s)) rotation = quaternion(*v);
    if (const auto v = animated(scene, clip, index, ChannelPath::scale, time_s)) {
        scale = {(*v)[0], (*v)[1], (*v)[2]};
    }
    const glm::dmat4 local =
        node.matrix ? *node.matrix
                    : local_of({.translation = translation, .rotation = rotation, .scale = scale});
    return node.parent ? world_of(scene, clip, *node.parent, time_s) * local : local;
}

Values weights_of(const Scene& scene, const Clip& clip, Index index, double time_s) {
    if (auto v = animated(scene, clip, index, ChannelPath::weights, time_s)) return *v;
    const Node& node = scene.nodes[index];
    const auto& resting = node.weights.empty() ? scene.meshes[*node.mesh].weights : node.weights;
    return {resting.begin(), resting.end()};
}

/// `base` plus the weighted displacements of vertex `v`.
glm::dvec3 morphed(glm::dvec3 base, const Primitive& primitive, const Values& weights, std::size_t v,
                   std::vector<glm::vec3> MorphTarget::*attribute) {
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
        const auto& displacements = primitive.targets[i].*attribute;
        if (!displacements.empty()) base += weights[i] * glm::dvec3{displacements[v]};
    }
    return base;
}

double size_of(const glm::dmat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

OracleVertex place(const Primitive& primitive, const Values& weights, std::size_t v, const glm::dmat4& map) {
    OracleVertex out;
    const glm::dvec3 position =
        morphed(primitive.positions[v], primitive, weights, v, &MorphTarget::positions);
    out.position = glm::dvec3{map * glm::dvec4{position, 1.0}};

    const glm::dmat3 linear{map};
    const double condition = size_of(linear) * size_of(glm::inverse(linear));
    if (primitive.normals.empty()) return out;
    const glm::dvec3 normal = morphed(primitive.normals[v], primitive, weights, v, &MorphTarget::normals);
    out.normal = glm::normalize(glm::inverseTranspose(linear) * normal);
    out.normal_condition = condition * condition / glm::length(normal);

    if (primitive.tangents.empty()) return out;
    const glm::dvec3 tangent =
        morphed(glm::dvec3{primitive.tangents[v]}, primitive, weights, v, &MorphTarget::tangents);
    const double side = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
    out.tangent = glm::dvec4{glm::normalize(linear * tangent), side * double(primitive.tangents[v].w)};
    out.tangent_condition = condition / glm::length(tangent);
    return out;
}

}  // namespace

std::vector<OracleVertex> oracle_vertices(const Scene& scene, const Clip& clip, double time_s) {
    std::vector<OracleVertex> vertices;
    for (const Index index : nodes_in_order(scene, clip)) {
        const Node& node = scene.nodes[index];
        if (!node.mesh) continue;
        const Values weights = weights_of(scene, clip, index, time_s);
        const glm::dmat4 world = world_of(scene, clip, index, time_s);
        std::vector<glm::dmat4> joints;
        for (std::size_t j = 0; node.skin && j < scene.skins[*node.skin].joints.size(); ++j) {
            const Skin& skin = scene.skins[*node.skin];
            joints.push_back(world_of(scene, clip, skin.joints[j], time_s) * skin.inverse_bind[j]);
        }
        const std::size_t copies = std::max<std::size_t>(1, node.instances.size());
        for (std::size_t copy = 0; copy < copies; ++copy)
            for (const Primitive& primitive : scene.meshes[*node.mesh].primitives) {
                const Influences& influences = primitive.influences;
                for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
                    glm::dmat4 map = node.instances.empty() ? world : world * local_of(node.instances[copy]);
                    if (node.skin && influences.per_vertex > 0) {
                        map = glm::dmat4{0.0};
                        double sum = 0.0;
                        for (std::size_t i = 0; i < influences.per_vertex; ++i) {
                            const std::size_t at = v * influences.per_vertex + i;
                            map += double(influences.weights[at]) * joints[influences.joints[at]];
                            sum += double(influences.weights[at]);
                        }
                        map /= sum;
                    }
                    vertices.push_back(place(primitive, weights, v, map));
                }
            }
    }
    return vertices;
}

}  // namespace gridreel::anim::testing
