#include "random_scene.h"

#include "scene_builder.h"

#include <random>

namespace gridreel::anim::testing {
namespace {

class Dice {
public:
    explicit Dice(std::uint32_t seed) : engine_(seed) {}

    /// In [low, high).
    double real(double low, double high) { return low + (high - low) * (double(engine_()) / 4294967296.0); }
    float number(double low, double high) { return static_cast<float>(real(low, high)); }
    Index below(std::size_t count) { return static_cast<Index>(engine_() % count); }
    bool one_in(std::uint32_t n) { return engine_() % n == 0; }
    glm::dvec3 vector(double low, double high) {
        const double x = real(low, high), y = real(low, high), z = real(low, high);
        return {x, y, z};
    }
    glm::dquat rotation() {
        const double w = real(-1, 1), x = real(-1, 1), y = real(-1, 1), z = real(0.1, 1);
        return glm::normalize(glm::dquat{w, x, y, z});
    }

private:
    std::mt19937 engine_;
};

Trs random_trs(Dice& dice) {
    Trs trs{.translation = dice.vector(-1, 1), .rotation = dice.rotation(), .scale = dice.vector(0.6, 1.5)};
    if (dice.one_in(5)) trs.scale[static_cast<int>(dice.below(3))] *= -1.0;
    return trs;
}

Node random_node(Dice& dice) {
    Node node = placed(random_trs(dice));
    if (dice.one_in(6)) {
        glm::dmat4 matrix{1.0};
        for (int column = 0; column < 4; ++column) {
            matrix[column] += glm::dvec4{dice.vector(-0.3, 0.3), 0.0};
        }
        node.matrix = matrix;
    }
    return node;
}

/// `count` vectors in a cube of half-width `size`.
std::vector<glm::vec3> cloud(Dice& dice, std::size_t count, double size) {
    std::vector<glm::vec3> all;
    for (std::size_t i = 0; i < count; ++i) all.emplace_back(dice.vector(-size, size));
    return all;
}

void add_influences(Dice& dice, Primitive& primitive, std::size_t joints) {
    primitive.influences.per_vertex = dice.one_in(2) ? 4 : 8;
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        std::vector<double> weights(primitive.influences.per_vertex);
        double sum = 0.0;
        for (double& weight : weights) sum += weight = dice.one_in(3) ? 0.0 : dice.real(0.01, 1);
        if (sum == 0.0) sum = weights[0] = 1.0;
        for (const double weight : weights) {
            primitive.influences.weights.push_back(static_cast<float>(weight / sum));
            primitive.influences.joints.push_back(static_cast<std::uint16_t>(dice.below(joints)));
        }
    }
}

Primitive random_primitive(Dice& dice, std::size_t vertices, std::size_t targets) {
    Primitive primitive = points(cloud(dice, vertices, 1.0));
    for (std::uint32_t v = 0; v + 2 < vertices; v += 3) primitive.triangles.emplace_back(v, v + 1, v + 2);
    if (!dice.one_in(4)) {
        for (std::size_t v = 0; v < vertices; ++v) {
            primitive.normals.emplace_back(dice.rotation() * glm::dvec3{0, 0, 1});
        }
        if (dice.one_in(2)) {
            for (std::size_t v = 0; v < vertices; ++v) {
                primitive.tangents.emplace_back(glm::vec3{dice.rotation() * glm::dvec3{1, 0, 0}},
                                                dice.one_in(2) ? 1.0f : -1.0f);
            }
        }
    }
    for (std::size_t i = 0; i < targets; ++i) {
        MorphTarget target;
        if (!dice.one_in(4)) target.positions = cloud(dice, vertices, 0.3);
        if (!dice.one_in(4)) target.normals = cloud(dice, vertices, 0.2);
        if (!dice.one_in(4)) target.tangents = cloud(dice, vertices, 0.2);
        primitive.targets.push_back(target);
    }
    return primitive;
}

/// Three or so keys between 0 and 2 s, of `value()`s that `width` numbers make up.
template <class Value>
Sampler random_keys(Dice& dice, std::uint32_t width, Value value) {
    Sampler sampler;
    sampler.width = width;
    sampler.interpolation = static_cast<Interpolation>(dice.below(3));
    const bool cubic = sampler.interpolation == Interpolation::cubic_spline;
    const auto tangent = [&] {
        for (std::uint32_t i = 0; cubic && i < width; ++i) sampler.values.push_back(dice.number(-0.3, 0.3));
    };
    float time_s = dice.number(0, 0.5);
    for (std::uint32_t key = 0, count = 1 + dice.below(4); key < count; ++key) {
        sampler.times_s.push_back(time_s);
        time_s += dice.number(0.1, 0.5);
        tangent();
        for (const double number : value()) sampler.values.push_back(static_cast<float>(number));
        tangent();
    }
    return sampler;
}

void animate(Dice& dice, Scene& scene, Index animation, Index node) {
    const auto vector = [&](double low, double high) {
        return random_keys(dice, 3, [&dice, low, high] {
            const glm::dvec3 v = dice.vector(low, high);
            return std::vector{v.x, v.y, v.z};
        });
    };
    if (dice.one_in(2)) drive(scene, animation, node, ChannelPath::translation, vector(-1, 1));
    if (dice.one_in(3)) drive(scene, animation, node, ChannelPath::scale, vector(0.6, 1.5));
    if (dice.one_in(2)) {
        drive(scene, animation, node, ChannelPath::rotation, random_keys(dice, 4, [&dice] {
                  const glm::dquat q = dice.rotation() * (dice.one_in(2) ? 1.0 : -1.0);
                  return std::vector{q.x, q.y, q.z, q.w};
              }));
    }
}

}  // namespace

Scene random_scene(std::uint32_t seed, const RandomSceneOptions& options) {
    Dice dice{seed};
    Scene scene = empty_scene();

    // Two trees, one of which no scene shows; its nodes serve as joints all the same.
    constexpr Index node_count = 16;
    add_node(scene, placed(moved(options.offset, -options.offset, 0.5 * options.offset)));
    const Index hidden = add_hidden_root(scene, scene.nodes[0]);
    for (Index i = hidden + 1; i < node_count; ++i) add_node(scene, random_node(dice), dice.below(i));

    // Skins of joints anywhere.
    for (int i = 0; i < 2; ++i) {
        std::vector<Index> joints;
        std::vector<glm::dmat4> inverse_bind;
        for (Index count = 2 + dice.below(5), j = 0; j < count; ++j) {
            joints.push_back(dice.below(node_count));
            glm::dmat4 matrix = glm::mat4_cast(dice.rotation());
            matrix[3] = glm::dvec4{dice.vector(-0.5, 0.5), 1.0};
            inverse_bind.push_back(matrix);
        }
        add_skin(scene, joints, inverse_bind);
    }

    // A mesh on most nodes: rigid or skinned, with up to three targets.
    for (Index node = 0; node < node_count; ++node) {
        if (dice.one_in(4)) continue;
        const std::size_t targets = dice.below(4);
        Primitive primitive = random_primitive(dice, options.vertices_per_part, targets);
        if (dice.one_in(2)) {
            const Index skin = dice.below(scene.skins.size());
            scene.nodes[node].skin = skin;
            add_influences(dice, primitive, scene.skins[skin].joints.size());
        } else if (dice.one_in(3)) {
            for (int i = 0; i < 3; ++i) scene.nodes[node].instances.push_back(random_trs(dice));
        }
        std::vector<float> weights(targets);
        for (float& weight : weights) weight = dice.one_in(3) ? 0.0f : dice.number(-0.5, 1);
        scene.nodes[node].mesh = add_mesh(scene, primitive, weights);
        if (dice.one_in(2)) scene.nodes[node].weights.assign(targets, 0.25f);
    }

    // Two animations that may meet.
    for (int i = 0; i < 2; ++i) {
        const Index animation = add_animation(scene);
        for (Index node = hidden + 1; node < node_count; ++node) {
            if (!scene.nodes[node].matrix && dice.one_in(2)) animate(dice, scene, animation, node);
            const std::optional<Index> mesh = scene.nodes[node].mesh;
            const std::size_t targets = mesh ? scene.meshes[*mesh].weights.size() : 0;
            if (targets == 0 || !dice.one_in(2)) continue;
            drive(scene, animation, node, ChannelPath::weights,
                  random_keys(dice, static_cast<std::uint32_t>(targets), [&dice, targets] {
                      std::vector<double> weights(targets);
                      for (double& weight : weights) weight = dice.real(-0.5, 1);
                      return weights;
                  }));
        }
    }
    return scene;
}

}  // namespace gridreel::anim::testing
