#pragma once
// Whether a clip looks the same at two times, as the ends of a loop do.

#include "anim/clip.h"
#include "anim/scene.h"

namespace gridreel::anim {

/// Every property that the clip animates has the same value at both times, but for what rounding leaves where
/// exporters write the end of a loop anew: a hundred-thousandth of the way that the keys of each number go,
/// and a few roundings of the number itself. Turns of a quaternion and its negative are the same. What one
/// animation drives and another overrides counts, too.
[[nodiscard]] bool repeats(const Scene& scene, const Clip& clip, double time_s, double other_time_s);

}  // namespace gridreel::anim
