#pragma once
// The skinned figure on its way: mesh, skeleton, steps.

#include "tools/gallery/document.h"

#include <cstddef>

namespace gridreel::gallery {

/// Adds the figure's mesh with its skin, and a node that shows it. The document's first skin must be the
/// one of `add_skeleton`, called afterwards.
void add_figure(Document& document, std::size_t triangles);

/// Adds the joints as nodes, and their skin.
/// @return the hips; the other joints follow in the order of `Joint`
[[nodiscard]] Id add_skeleton(Document& document);

struct Walk {
    int cycles = 1;         ///< of two steps each; one takes `cycle_duration_s` and goes `stride_m`
    glm::dvec3 start{0.0};  ///< where the hips' projection on the floor sets out, towards +x
};

/// Animates the joints on the spot, and `companion` forwards: whatever is its child goes with the figure,
/// the hips above all.
void add_walk(Document& document, Id first_joint, Id companion, const Walk& way);

}  // namespace gridreel::gallery
