#pragma once
// Where the nodes of a file are at one time, whether they are shown, and how they morph.

#include "clip.h"
#include "file.h"
#include "matrix.h"

#include <cstddef>
#include <vector>

namespace gridreel::evaluator {

struct NodeState {
    Matrix world = identity;      ///< section 3.5.3
    bool visible = true;          ///< it and all above it are (KHR_node_visibility)
    std::vector<double> weights;  ///< of the morph targets of its mesh (section 3.7.4)
};

/// One per node of the file.
[[nodiscard]] std::vector<NodeState> nodes_at(const File& file, const Clip& clip, double time_s);

/// One per node of the file: whether it is set visible at some time of the clip, and so is each node above
/// it, not necessarily at the same time.
[[nodiscard]] std::vector<bool> nodes_ever_visible(const File& file, const Clip& clip);

/// The nodes of a scene, depth first in file order.
[[nodiscard]] std::vector<std::size_t> nodes_of_scene(const File& file, std::size_t scene);

/// The scene that the file shows: its `scene`, or the first.
[[nodiscard]] std::size_t default_scene(const File& file);

}  // namespace gridreel::evaluator
