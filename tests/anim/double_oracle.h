#pragma once
// The vertices of a frame once more: slowly, in double throughout, and by other formulas.

#include "anim/clip.h"
#include "anim/scene.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace gridreel::anim::testing {

struct OracleVertex {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0};         ///< unit; zero without normals
    glm::dvec4 tangent{0.0};        ///< xyz unit; zero without tangents
    double normal_condition = 1.0;  ///< by how much rounding errors of the inputs may grow in `normal`
    double tangent_condition = 1.0;
};

/// Vertices of all parts, in the order of `FrameGeometry`.
[[nodiscard]] std::vector<OracleVertex> oracle_vertices(const Scene& scene, const Clip& clip, double time_s);

}  // namespace gridreel::anim::testing
