#pragma once
// Waves that travel exactly although morph targets only add up.

#include "tools/gallery/document.h"

#include <span>

namespace gridreel::gallery {

/// The two targets of one frequency: a sin(phase - w t) = cos(w t) [a sin(phase)] + sin(w t) [-a cos(phase)].
/// A surface stores the brackets as targets 2i and 2i + 1; `add_wave_weights` animates their weights.
///
/// @param node       shows a mesh with 2 * cycles.size() targets
/// @param cycles     whole cycles of each frequency within the clip, so that it loops
/// @param duration_s of the clip
/// @param keys       intervals between keys. Cubic splines with the exact slopes: with 24 keys a
///                   cycle, off by less than 2e-5 of the amplitude
void add_wave_weights(Document& document, Id node, std::span<const int> cycles, double duration_s, int keys);

}  // namespace gridreel::gallery
