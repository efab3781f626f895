#include "anim/vertex_transform.h"

#include <algorithm>
#include <array>

namespace gridreel::anim {
namespace {

glm::vec3 place(const glm::vec3& origin, const AffineRows& rows, const glm::vec3& position) {
    return origin + glm::vec4{position, 1.0f} * rows;
}

glm::vec4 turn(const DirectionMap& map, const glm::vec4& tangent) {
    return {map_tangent(map, glm::vec3{tangent}), tangent.w * map.handedness};
}

glm::mat3 linear_rows(const AffineRows& rows) {
    return {glm::vec3{rows[0]}, glm::vec3{rows[1]}, glm::vec3{rows[2]}};
}

/// A vertex's own map: the weighted sum of its joints'.
AffineRows blend(std::span<const AffineRows> rows, const std::uint16_t* joints, const float* weights,
                 std::size_t count) {
    AffineRows sum = weights[0] * rows[joints[0]];
    for (std::size_t i = 1; i < count; ++i) sum += weights[i] * rows[joints[i]];
    return sum;
}

}  // namespace

void transform_rigid(const Placement& placement, const AffineRows& rows, const VertexSpans& vertices) {
    for (glm::vec3& position : vertices.positions) position = place(placement.origin, rows, position);
    for (glm::vec3& normal : vertices.normals) normal = map_normal(placement.directions, normal);
    for (glm::vec4& tangent : vertices.tangents) tangent = turn(placement.directions, tangent);
}

void transform_skinned(const Placement& placement, std::span<const AffineRows> rows,
                       const Influences& influences, std::size_t first, const VertexSpans& vertices) {
    // A block's blended maps stay in the first-level cache for the loops over its attributes, none of
    // which then has to ask which attributes there are.
    constexpr std::size_t longest_block = 64;
    std::array<AffineRows, longest_block> blended;

    const std::size_t per_vertex = influences.per_vertex;
    const std::size_t total = vertices.positions.size();
    for (std::size_t begin = 0; begin < total; begin += longest_block) {
        const std::size_t count = std::min(longest_block, total - begin);
        const std::uint16_t* joints = influences.joints.data() + (first + begin) * per_vertex;
        const float* weights = influences.weights.data() + (first + begin) * per_vertex;
        for (std::size_t v = 0; v < count; ++v) {
            blended[v] = blend(rows, joints + v * per_vertex, weights + v * per_vertex, per_vertex);
        }

        const auto positions = vertices.positions.subspan(begin, count);
        for (std::size_t v = 0; v < count; ++v) {
            positions[v] = place(placement.origin, blended[v], positions[v]);
        }
        if (!vertices.normals.empty()) {
            const auto normals = vertices.normals.subspan(begin, count);
            for (std::size_t v = 0; v < count; ++v) {
                normals[v] = map_normal(direction_map(linear_rows(blended[v])), normals[v]);
            }
        }
        if (!vertices.tangents.empty()) {
            const auto tangents = vertices.tangents.subspan(begin, count);
            for (std::size_t v = 0; v < count; ++v) {
                tangents[v] = turn(direction_map(linear_rows(blended[v])), tangents[v]);
            }
        }
    }
}

}  // namespace gridreel::anim
