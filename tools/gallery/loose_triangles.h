#pragma once
// Triangles that share no corners, as a mesh of flat faces with morph targets.

#include "tools/gallery/document.h"

#include <glm/gtc/type_precision.hpp>

#include <string>
#include <vector>

namespace gridreel::gallery {

/// Three corners a triangle, counter-clockwise; metres.
struct LooseTriangles {
    std::vector<glm::vec3> corners{};
    std::vector<std::vector<glm::vec3>> targets{};  ///< of each morph target: displacements, one per corner
    std::vector<glm::u8vec4> colors{};              ///< linear RGBA, one per corner
    std::vector<double> weights{};                  ///< of the targets at rest
};

/// Adds them as a mesh without normals: glTF then shades every triangle flat, however it has turned.
[[nodiscard]] Id add_loose_mesh(Document& document, std::string name, const LooseTriangles& triangles,
                                Id material);

}  // namespace gridreel::gallery
