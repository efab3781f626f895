#pragma once
// The order in which a tree of nodes is walked.

#include "anim/scene.h"

#include <span>
#include <vector>

namespace gridreel::anim {

/// The nodes under `roots`, depth first, children in file order: every node after its parent.
[[nodiscard]] std::vector<Index> depth_first(const Scene& scene, std::span<const Index> roots);

/// All nodes of the file, in any of its scenes or in none, every node after its parent.
[[nodiscard]] std::vector<Index> all_parents_first(const Scene& scene);

}  // namespace gridreel::anim
