#pragma once
// Nothing stands still: for measuring what it costs when everything moves.

#include "tools/gallery/document.h"

namespace gridreel::gallery {

/// Hangs every mesh that no animation reaches under a new node that goes round a circle of 1 cm once in
/// the clip, so that each of its triangles is somewhere else in every frame. What hangs on it goes along.
/// Does nothing when everything moves already, or when there is no clip to move in.
void keep_moving(Document& document);

}  // namespace gridreel::gallery
