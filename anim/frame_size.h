#pragma once
// How much memory the frames of a clip take, before any of it is allocated.

#include "anim/clip.h"
#include "anim/scene.h"

namespace gridreel::anim {

/// What `lay_out` would allocate. Counted in double: a file of a few bytes can name more than 2^64 of them.
struct FrameSize {
    double vertices = 0.0;
    double triangles = 0.0;
    double bytes = 0.0;
    Index largest_node = 0;  ///< the one whose mesh takes most of them, with its instances
};

/// Every node of the clip's scene that is ever shown, with all its instances.
/// Takes time in proportion to the nodes and primitives of the file, whatever they multiply to.
[[nodiscard]] FrameSize measure_frame(const Scene& scene, const Clip& clip);

/// A few bytes of a file can hang one mesh on many nodes, and place a million instances of it. A frame may
/// take 4 GiB plus four times what all meshes of the file take, and no more: what `load` promises of those
/// makes it 6 GiB plus 512 times the bytes read.
/// @throws Error at the node that takes most when the clip's frames would
void check_frame_size(const Scene& scene, const Clip& clip);

}  // namespace gridreel::anim
