#include "anim/gltf/triangles.h"

#include <cassert>

namespace gridreel::anim::gltf {

bool has_triangles(Topology topology) {
    return topology >= Topology::triangles;
}

bool is_whole(Topology topology, std::size_t index_count) {
    return index_count >= 3 && (topology != Topology::triangles || index_count % 3 == 0);
}

std::vector<glm::uvec3> assemble_triangles(Topology topology, std::span<const std::uint32_t> indices) {
    assert(has_triangles(topology));
    std::vector<glm::uvec3> triangles;
    if (indices.size() < 3) return triangles;

    if (topology == Topology::triangles) {
        triangles.reserve(indices.size() / 3);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        return triangles;
    }

    triangles.reserve(indices.size() - 2);
    for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
        if (topology == Topology::triangle_strip)
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        else
            triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
    }
    return triangles;
}

}  // namespace gridreel::anim::gltf
