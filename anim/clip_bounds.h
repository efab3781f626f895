#pragma once
// The room a clip takes up, for cameras that must see all of it.

#include "anim/box.h"
#include "anim/clip.h"
#include "anim/scene.h"

namespace gridreel::anim {

/// The box, in the world and metres, of every triangle corner at 32 evenly spaced times from 0 to the clip's
/// end, both included; at time 0 alone when nothing moves. Vertices that no triangle uses, or that are not
/// finite, do not count, nor do parts while they are hidden, unless they are hidden at all those times. What
/// sticks out only between two of those times is missed.
///
/// Deterministic, parallel in the caller's arena.
[[nodiscard]] Box clip_bounds(const Scene& scene, const Clip& clip);

}  // namespace gridreel::anim
