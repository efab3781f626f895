#pragma once
// The inner loop of sorting rays, chosen for the machine's SIMD instructions at run time.

#include "traversal/ray_sort.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// What work on rays must be cut at: a multiple of the lanes of every target.
inline constexpr std::size_t rays_per_step = 16;

/// From slopes, or places of parallel rays, to keys: `(slope - low[face]) * scale[face]` is a cell of the
/// curve's square. Zero for the dead.
struct KeyMap {
    std::array<float, face_count + 1> low_u{}, low_v{}, scale{};
};

/// Frames rays [begin, end) of a batch, the same bits as `ray_frame`, and makes their keys.
/// @param begin   a multiple of `rays_per_step`; so is `end`, unless it is the batch's
/// @param framed  of the whole batch; parallel rays are not framed
/// @param keys    of the rays wanted, one after the other
/// @param only    of the whole batch: rays where it is `undecided` are wanted, no others; null: all are
/// @return how many keys there are
std::size_t frame_and_key(const RayBatch& rays, std::size_t begin, std::size_t end,
                          const OcclusionBatch* only, const KeyMap& map, FramedRay* framed,
                          std::uint64_t* keys);

}  // namespace gridreel::traversal
