#include "scene_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gridreel::anim::testing {
namespace {

template <class Vector>
double largest_difference(const Vector& a, const Vector& b) {
    double largest = 0.0;
    for (int i = 0; i < Vector::length(); ++i) {
        const double difference = std::abs(double(a[i]) - double(b[i]));
        if (std::isnan(difference)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, difference);
    }
    return largest;
}

}  // namespace

Scene empty_scene() {
    Scene scene;
    scene.name = "test";
    scene.scenes.resize(1);
    return scene;
}

Index add_hidden_root(Scene& scene, Node node) {
    scene.nodes.push_back(std::move(node));
    return static_cast<Index>(scene.nodes.size() - 1);
}

Index add_node(Scene& scene, Node node, std::optional<Index> parent) {
    node.parent = parent;
    const Index index = add_hidden_root(scene, std::move(node));
    (parent ? scene.nodes[*parent].children : scene.scenes[0]).push_back(index);
    return index;
}

Node placed(const Trs& trs, std::optional<Index> mesh) {
    Node node;
    node.trs = trs;
    node.mesh = mesh;
    return node;
}

Index add_mesh(Scene& scene, Primitive primitive, std::vector<float> weights) {
    if (weights.empty()) weights.resize(primitive.targets.size(), 0.0f);
    scene.meshes.push_back({.name = {}, .primitives = {std::move(primitive)}, .weights = std::move(weights)});
    return static_cast<Index>(scene.meshes.size() - 1);
}

Index add_skin(Scene& scene, std::vector<Index> joints, std::vector<glm::dmat4> inverse_bind) {
    inverse_bind.resize(joints.size(), glm::dmat4{1.0});
    scene.skins.push_back({.name = {}, .joints = std::move(joints), .inverse_bind = std::move(inverse_bind)});
    return static_cast<Index>(scene.skins.size() - 1);
}

Primitive points(std::vector<glm::vec3> positions) {
    Primitive primitive;
    primitive.positions = std::move(positions);
    return primitive;
}

Primitive triangle() {
    Primitive primitive = points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    primitive.normals.assign(3, {0, 0, 1});
    primitive.triangles = {{0, 1, 2}};
    return primitive;
}

MorphTarget shift(std::vector<glm::vec3> positions) {
    MorphTarget target;
    target.positions = std::move(positions);
    return target;
}

void bind(Primitive& primitive, std::vector<std::uint16_t> joints, std::vector<float> weights) {
    primitive.influences.per_vertex = static_cast<std::uint32_t>(joints.size());
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        auto& to = primitive.influences;
        to.joints.insert(to.joints.end(), joints.begin(), joints.end());
        to.weights.insert(to.weights.end(), weights.begin(), weights.end());
    }
}

Sampler keys(Interpolation interpolation, std::uint32_t width, std::vector<float> times_s,
             std::vector<float> values) {
    return {.times_s = std::move(times_s),
            .values = std::move(values),
            .width = width,
            .interpolation = interpolation};
}

Index add_animation(Scene& scene, std::string name) {
    scene.animations.push_back({.name = std::move(name), .samplers = {}, .channels = {}});
    return static_cast<Index>(scene.animations.size() - 1);
}

void drive(Scene& scene, Index animation, Index node, ChannelPath path, Sampler sampler) {
    Animation& to = scene.animations[animation];
    to.channels.push_back({.object = node, .path = path, .sampler = static_cast<Index>(to.samplers.size())});
    to.samplers.push_back(std::move(sampler));
}

Trs moved(double x, double y, double z) {
    Trs trs;
    trs.translation = {x, y, z};
    return trs;
}

Trs scaled(double x, double y, double z) {
    Trs trs;
    trs.scale = {x, y, z};
    return trs;
}

Trs turned(double degrees, const glm::dvec3& axis) {
    Trs trs;
    trs.rotation = glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
    return trs;
}

FrameGeometry frame_at(const Scene& scene, double time_s) {
    const Clip clip = choose_clip(scene, "all");
    FrameGeometry geometry = lay_out(scene, clip);
    deform(scene, pose(scene, clip, time_s), geometry);
    return geometry;
}

double distance(const glm::vec3& a, const glm::vec3& b) {
    return largest_difference(a, b);
}

double distance(const glm::vec4& a, const glm::vec4& b) {
    return largest_difference(a, b);
}

double distance(const glm::dvec3& a, const glm::dvec3& b) {
    return largest_difference(a, b);
}

double distance(const glm::dmat4& a, const glm::dmat4& b) {
    double largest = 0.0;
    for (int column = 0; column < 4; ++column) {
        largest = std::max(largest, largest_difference(a[column], b[column]));
    }
    return largest;
}

}  // namespace gridreel::anim::testing
