#pragma once
// Everything animated, at one time.

#include "anim/clip.h"
#include "anim/scene.h"

#include <glm/mat4x4.hpp>

#include <vector>

namespace gridreel::anim {

/// World matrices, morph weights and everything else that can be animated, at one time.
struct Pose {
    double time_s = 0.0;
    std::vector<glm::dmat4> world;            ///< one per node of the file
    std::vector<std::vector<float>> weights;  ///< one list per node; empty for nodes without morph targets
    std::vector<bool> visible;                ///< one per node: it and all above it are shown
    std::vector<Camera> cameras;              ///< as `Scene::cameras`, with animated values
    std::vector<Light> lights;                ///< as `Scene::lights`
    std::vector<Material> materials;          ///< as `Scene::materials`
};

/// Evaluates the clip's animations at `time_s` (glTF 2.0, section 3.11.3 and appendix C).
///
/// Before its first key and after its last a channel holds the nearest key's value.
/// Pure: the same answer for the same arguments, on every thread.
[[nodiscard]] Pose pose(const Scene& scene, const Clip& clip, double time_s);

}  // namespace gridreel::anim
