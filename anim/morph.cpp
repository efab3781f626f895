#include "anim/morph.h"

#include <algorithm>
#include <cassert>

namespace gridreel::anim {
namespace {

void displace(glm::vec3& vector, const glm::vec3& by) {
    vector += by;
}

/// A tangent: its w is no length.
void displace(glm::vec4& vector, const glm::vec3& by) {
    vector += glm::vec4{by, 0.0f};
}

/// Adds the attribute that `displacements` names of every target, where the target has it.
template <class Vector>
void add_targets(const Primitive& primitive, std::span<const float> weights,
                 std::vector<glm::vec3> MorphTarget::*displacements, std::size_t first,
                 std::span<Vector> out) {
    assert(primitive.targets.size() == weights.size());
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
        const std::vector<glm::vec3>& all = primitive.targets[i].*displacements;
        const float weight = weights[i];
        if (all.empty() || weight == 0.0f) continue;
        const std::span<const glm::vec3> run = std::span{all}.subspan(first, out.size());
        for (std::size_t v = 0; v < out.size(); ++v) displace(out[v], weight * run[v]);
    }
}

}  // namespace

void morph_positions(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                     const glm::vec3& centre, std::span<glm::vec3> out) {
    const std::span<const glm::vec3> run = std::span{primitive.positions}.subspan(first, out.size());
    std::transform(run.begin(), run.end(), out.begin(), [&](const glm::vec3& p) { return p - centre; });
    add_targets(primitive, weights, &MorphTarget::positions, first, out);
}

void morph_normals(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                   std::span<glm::vec3> out) {
    const std::span<const glm::vec3> run = std::span{primitive.normals}.subspan(first, out.size());
    std::copy(run.begin(), run.end(), out.begin());
    add_targets(primitive, weights, &MorphTarget::normals, first, out);
}

void morph_tangents(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                    std::span<glm::vec4> out) {
    const std::span<const glm::vec4> run = std::span{primitive.tangents}.subspan(first, out.size());
    std::copy(run.begin(), run.end(), out.begin());
    add_targets(primitive, weights, &MorphTarget::tangents, first, out);
}

}  // namespace gridreel::anim
