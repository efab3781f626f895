#include "tools/gallery/loose_triangles.h"

#include "tools/gallery/packing.h"

#include <cassert>
#include <cstdint>
#include <utility>

namespace gridreel::gallery {

Id add_loose_mesh(Document& document, std::string name, const LooseTriangles& triangles, Id material) {
    assert(triangles.corners.size() % 3 == 0 && triangles.colors.size() == triangles.corners.size());
    Mesh mesh{.name = std::move(name), .material = material, .weights = triangles.weights};
    mesh.attributes = {{"POSITION", add_positions(document, triangles.corners)},
                       {"COLOR_0", add_colors(document, triangles.colors)}};
    for (const auto& target : triangles.targets) {
        assert(target.size() == triangles.corners.size());
        mesh.targets.push_back({{"POSITION", add_positions(document, target)}});
    }

    std::vector<glm::uvec3> in_order(triangles.corners.size() / 3);
    for (std::uint32_t i = 0; i < in_order.size(); ++i) in_order[i] = {3 * i, 3 * i + 1, 3 * i + 2};
    mesh.indices = add_indices(document, in_order, triangles.corners.size());
    return append(document.meshes, std::move(mesh));
}

}  // namespace gridreel::gallery
