#pragma once
// Which nodes are shown (KHR_node_visibility).

#include "anim/clip.h"
#include "anim/scene.h"

#include <vector>

namespace gridreel::anim {

enum class Shown { never, sometimes, always };

/// Over the whole clip, one per node of the file, found without evaluating any time.
/// A node is hidden wherever one of its ancestors is.
[[nodiscard]] std::vector<Shown> shown_in(const Scene& scene, const Clip& clip);

/// Hides what stands below hidden nodes.
/// @param visible  each node's own flag; on return, whether it is shown
void inherit_visibility(const Scene& scene, std::vector<bool>& visible);

}  // namespace gridreel::anim
