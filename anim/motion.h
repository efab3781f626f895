#pragma once
// What can move at all during a clip, found from its channels without evaluating any time.

#include "anim/clip.h"
#include "anim/scene.h"

#include <vector>

namespace gridreel::anim {

/// One flag per node of the file.
struct Motion {
    std::vector<bool> world;    ///< its world matrix can differ between two times
    std::vector<bool> weights;  ///< its morph weights can
};

[[nodiscard]] Motion find_motion(const Scene& scene, const Clip& clip);

/// Whether the vertices of `primitive`, hung on `node`, can differ between two times.
[[nodiscard]] bool moves(const Scene& scene, const Motion& motion, Index node, const Primitive& primitive);

/// Whether joints place the vertices, and the node's own matrix is ignored (glTF 2.0, section 3.7.3.3).
[[nodiscard]] bool is_skinned(const Node& node, const Primitive& primitive);

}  // namespace gridreel::anim
