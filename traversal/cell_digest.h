#pragma once
// What incoherent rays ask about cells before they read the lists.

#include "traversal/cell_distances.h"
#include "traversal/reference_boxes.h"

namespace gridreel::traversal {

/// Borrowed, of the grid as it is.
struct CellDigest {
    const CellDistances& distances;
    const ReferenceBoxes* boxes = nullptr;  ///< none: too few rays to be worth it
};

}  // namespace gridreel::traversal
