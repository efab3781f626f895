#pragma once
// What an animation channel drives: a node's path, or whatever a JSON pointer of KHR_animation_pointer leads
// to.

#include "anim/gltf/place.h"
#include "anim/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gridreel::anim::gltf {

/// A property that can be animated, and what its keys must look like.
struct ChannelTarget {
    ChannelPath path = ChannelPath::translation;
    Index object = 0;          ///< as in `Channel`
    Index property = 0;        ///< as in `Channel`
    std::string_view element;  ///< of the key values: "VEC3"
    std::size_t elements_per_key = 1;
    bool by_pointer = false;  ///< such keys may be integers of any kind
};

/// A channel's target: the property that it drives, or why it drives nothing that is drawn.
struct ResolvedTarget {
    std::optional<ChannelTarget> target;
    std::string ignored;  ///< what is not supported, as the file names it; empty: nothing to complain about
};

/// @param target  `channel.target`, of a valid shape
/// @throws Error for a node without what is animated, and for pointers that lead nowhere
[[nodiscard]] ResolvedTarget resolve_target(const Place& target, const Place& root);

}  // namespace gridreel::anim::gltf
