#include "anim/morph.h"

#include <glm/vec4.hpp>

#include <algorithm>
#include <cassert>
#include <vector>

namespace gridreel::anim {
namespace {

using Displacements = std::vector<glm::vec3> MorphTarget::*;

void displace(glm::vec3& vector, const glm::vec3& by) {
    vector += by;
}

/// A tangent: its w is no length.
void displace(glm::vec4& vector, const glm::vec3& by) {
    vector += glm::vec4{by, 0.0f};
}

/// The morph targets of one primitive and what they weigh.
class WeightedTargets {
public:
    WeightedTargets(const Primitive& primitive, std::span<const float> weights)
        : targets_(primitive.targets), weights_(weights) {
        assert(targets_.size() == weights_.size());
    }

    [[nodiscard]] bool displace_any(Displacements attribute) const {
        for (std::size_t i = 0; i < targets_.size(); ++i) {
            if (counts(i, attribute)) return true;
        }
        return false;
    }

    /// Adds the displacements of the vertices from `first` on.
    template <class Vector>
    void add(Displacements attribute, std::size_t first, std::span<Vector> out) const {
        for (std::size_t i = 0; i < targets_.size(); ++i) {
            if (!counts(i, attribute)) continue;
            const std::span<const glm::vec3> run =
                std::span{targets_[i].*attribute}.subspan(first, out.size());
            for (std::size_t v = 0; v < out.size(); ++v) displace(out[v], weights_[i] * run[v]);
        }
    }

private:
    [[nodiscard]] bool counts(std::size_t i, Displacements attribute) const {
        return weights_[i] != 0.0f && !(targets_[i].*attribute).empty();
    }

    std::span<const MorphTarget> targets_;
    std::span<const float> weights_;
};

/// `all` from `first` on: as they are, or displaced in `room`.
template <class Vector>
std::span<const Vector> displaced(const std::vector<Vector>& all, const WeightedTargets& targets,
                                  Displacements attribute, std::size_t first, std::span<Vector> room) {
    if (room.empty()) return {};
    const std::span<const Vector> run = std::span{all}.subspan(first, room.size());
    if (!targets.displace_any(attribute)) return run;
    std::copy(run.begin(), run.end(), room.begin());
    targets.add(attribute, first, room);
    return room;
}

}  // namespace

ShapeSpans morph(const Primitive& primitive, std::span<const float> weights, std::size_t first,
                 const glm::vec3& centre, const VertexSpans& room) {
    const WeightedTargets targets(primitive, weights);
    ShapeSpans shape{
        .positions = std::span{primitive.positions}.subspan(first, room.positions.size()),
        .normals = displaced(primitive.normals, targets, &MorphTarget::normals, first, room.normals),
        .tangents = displaced(primitive.tangents, targets, &MorphTarget::tangents, first, room.tangents),
        .centre = centre};
    if (!targets.displace_any(&MorphTarget::positions)) return shape;

    // Relative to the centre first: displacements are small, and would lose digits far from the origin.
    std::transform(shape.positions.begin(), shape.positions.end(), room.positions.begin(),
                   [&](const glm::vec3& p) { return p - centre; });
    targets.add(&MorphTarget::positions, first, room.positions);
    shape.positions = room.positions;
    shape.centre = glm::vec3{0.0f};
    return shape;
}

}  // namespace gridreel::anim
