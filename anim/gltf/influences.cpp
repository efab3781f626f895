#include "anim/gltf/influences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridreel::anim::gltf {
namespace {

constexpr std::uint32_t joints_per_set = 4;

/// Makes the weights of one vertex sum to 1 and clears the joints that have none.
void normalise(std::span<std::uint16_t> joints, std::span<float> weights) {
    double sum = 0.0;
    for (const float weight : weights) sum += double(weight);
    if (!(sum > 0.0)) {
        weights[0] = 1.0f;
        sum = 1.0;
        joints[0] = 0;
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] == 0.0f) joints[i] = 0;
        weights[i] = static_cast<float>(double(weights[i]) / sum);
    }
}

}  // namespace

Influences read_influences(Document& document, const Place& attributes) {
    Influences influences;
    std::uint32_t sets = 0;
    while (attributes.has(fmt::format("JOINTS_{}", sets))) ++sets;
    if (sets == 0) return influences;

    const std::size_t vertex_count = document.accessors()[attributes.at("JOINTS_0").index()].count;
    influences.per_vertex = sets * joints_per_set;
    document.budget().spend(vertex_count * influences.per_vertex * (sizeof(std::uint16_t) + sizeof(float)),
                            attributes);
    influences.joints.resize(vertex_count * influences.per_vertex);
    influences.weights.resize(vertex_count * influences.per_vertex);

    for (std::uint32_t set = 0; set < sets; ++set) {
        const Place joint_place = attributes.at(fmt::format("JOINTS_{}", set));
        const Place weight_place = attributes.at(fmt::format("WEIGHTS_{}", set));
        const auto joints = document.integers(joint_place.index(), joint_place);
        const auto weights = document.floats(weight_place.index(), weight_place);
        for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
            for (std::uint32_t i = 0; i < joints_per_set; ++i) {
                const std::size_t from = vertex * joints_per_set + i;
                const std::size_t to = vertex * influences.per_vertex + set * joints_per_set + i;
                if (!std::isfinite(weights[from]) || weights[from] < 0.0f)
                    weight_place.refuse(
                        fmt::format("vertex {} has the weight {}; weights are finite and not negative",
                                    vertex, weights[from]));
                influences.joints[to] = static_cast<std::uint16_t>(joints[from]);
                influences.weights[to] = weights[from];
            }
        }
    }

    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        const std::size_t first = vertex * influences.per_vertex;
        normalise(std::span(influences.joints).subspan(first, influences.per_vertex),
                  std::span(influences.weights).subspan(first, influences.per_vertex));
    }
    return influences;
}

void check_joints_exist(const Document& document, const Scene& scene) {
    // Once per mesh, as many nodes may share one.
    std::vector<std::uint16_t> last_joint(scene.meshes.size(), 0);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (const Primitive& primitive : scene.meshes[m].primitives)
            for (const std::uint16_t joint : primitive.influences.joints)
                last_joint[m] = std::max(last_joint[m], joint);

    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        if (!node.skin || !node.mesh) continue;
        const std::size_t joint_count = scene.skins[*node.skin].joints.size();
        if (last_joint[*node.mesh] >= joint_count)
            document.root()
                .at("nodes", n)
                .at("skin")
                .refuse(fmt::format("a vertex of mesh {} follows joint {}; skin {} has {} joints", *node.mesh,
                                    last_joint[*node.mesh], *node.skin, joint_count));
    }
}

}  // namespace gridreel::anim::gltf
