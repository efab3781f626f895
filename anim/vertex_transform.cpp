#include "anim/vertex_transform.h"

#include "anim/skin_kernel.h"

#include <algorithm>

namespace gridreel::anim {
namespace {

glm::vec3 place(const glm::vec3& origin, const AffineRows& rows, const glm::vec3& position) {
    return origin + glm::vec4{position, 1.0f} * rows;
}

glm::vec4 turn(const DirectionMap& map, const glm::vec4& tangent) {
    return {map_tangent(map, glm::vec3{tangent}), tangent.w * map.handedness};
}

DirectionMap directions_of(const SkinBlock& block, std::size_t v) {
    return direction_map(
        glm::mat3{glm::vec3{block.rows[0][v]}, glm::vec3{block.rows[1][v]}, glm::vec3{block.rows[2][v]}});
}

}  // namespace

void transform_rigid(const Placement& placement, const AffineRows& rows, const VertexSpans& vertices) {
    for (glm::vec3& position : vertices.positions) position = place(placement.origin, rows, position);
    for (glm::vec3& normal : vertices.normals) normal = map_normal(placement.directions, normal);
    for (glm::vec4& tangent : vertices.tangents) tangent = turn(placement.directions, tangent);
}

void transform_skinned(const Placement& placement, std::span<const AffineRows> rows,
                       const Influences& influences, std::size_t first, const VertexSpans& vertices) {
    SkinBlock block;
    block.has_normals = !vertices.normals.empty();
    const std::size_t per_vertex = influences.per_vertex;
    for (std::size_t begin = 0; begin < vertices.positions.size(); begin += SkinBlock::most) {
        block.count = std::min(SkinBlock::most, vertices.positions.size() - begin);
        const auto positions = vertices.positions.subspan(begin, block.count);
        const auto normals =
            vertices.normals.subspan(block.has_normals ? begin : 0, block.has_normals ? block.count : 0);
        std::copy(positions.begin(), positions.end(), block.positions.begin());
        std::copy(normals.begin(), normals.end(), block.normals.begin());
        skin(rows.data(), influences.joints.data() + (first + begin) * per_vertex,
             influences.weights.data() + (first + begin) * per_vertex, per_vertex, placement.origin, block);

        std::copy_n(block.positions.begin(), block.count, positions.begin());
        for (std::size_t v = 0; v < normals.size(); ++v) {
            const bool lost = block.normals[v] == glm::vec3{0.0f};
            normals[v] = lost ? map_normal(directions_of(block, v), normals[v]) : block.normals[v];
        }
        if (vertices.tangents.empty()) continue;
        const auto tangents = vertices.tangents.subspan(begin, block.count);
        for (std::size_t v = 0; v < block.count; ++v)
            tangents[v] = turn(directions_of(block, v), tangents[v]);
    }
}

}  // namespace gridreel::anim
