#pragma once
// A looping clip begun somewhere in its middle.

#include "anim/scene.h"

namespace gridreel::gallery {

/// The animation of `keys`, played from `phase_s` to the clip's end and on from its start, until `phase_s`
/// is met again: what a looping player shows at t + phase_s, for t from 0 to `duration_s`.
///
/// Linear and step keys are moved, and cut where the new clip begins; cubic splines become linear keys, 60
/// a second and at the spline's own. Where the clip's end does not meet its start, the jump takes one
/// step of a float.
///
/// @param path        how values are blended
/// @param phase_s     in [0, duration_s)
/// @param duration_s  of the clip, > 0: the sampler's last key or later
[[nodiscard]] anim::Sampler begun_at(const anim::Sampler& keys, anim::ChannelPath path, double phase_s,
                                     double duration_s);

}  // namespace gridreel::gallery
