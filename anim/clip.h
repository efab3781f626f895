#pragma once
// Which scene of the file is shown, and which of its animations play in it.

#include "anim/scene.h"

#include <optional>
#include <string_view>
#include <vector>

namespace gridreel::anim {

/// One scene of the file with the animations that play together in it.
struct Clip {
    Index scene = 0;
    std::vector<Index> animations;  ///< ascending; may be empty (a still)
    double duration_s = 0.0;        ///< the last key of `animations`; 0 for a still
};

/// Chooses what plays.
///
/// @param animation    "auto", "all", "none", an animation's name, or its number from 0.
///                     A name wins over a number. "auto" plays all when no two animate the same property of a
///                     node, else the first; those that only move nodes of other scenes do not count.
/// @param scene_index  a scene's number, or absent: the file's default
/// @throws Error listing the names there are, when nothing matches
[[nodiscard]] Clip choose_clip(const Scene& scene, std::string_view animation = "auto",
                               std::optional<Index> scene_index = {});

/// The nodes under the clip's scene, depth first in file order: the order of everything we emit.
[[nodiscard]] std::vector<Index> nodes_in_order(const Scene& scene, const Clip& clip);

}  // namespace gridreel::anim
