#pragma once
// The inner loops of sorting rays, chosen for the machine's SIMD instructions at run time.

#include "traversal/ray_sort.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// The slopes that occur on one face of the cube of directions; low > high where there are none.
struct SlopeBounds {
    float low_u = 2.0f, high_u = -2.0f, low_v = 2.0f, high_v = -2.0f;

    [[nodiscard]] bool empty() const { return low_u > high_u; }
    void extend(const SlopeBounds& other);
};
using FaceBounds = std::array<SlopeBounds, face_count>;

/// Frames rays [begin, end) of a batch: the same bits as `ray_frame`.
/// @param faces  `Axes::face` of each ray, or `face_count` if it hits nothing
/// @return the bounds of their slopes
FaceBounds frame_rays(const RayBatch& rays, std::size_t begin, std::size_t end, FramedRay* framed,
                      std::uint32_t* faces);

/// From slopes to keys: `first[face] + `hilbert_place` of ((slope - low[face]) * scale[face])`.
struct KeyMap {
    std::array<std::uint32_t, face_count + 1> first{};
    std::array<float, face_count + 1> low_u{}, low_v{}, scale{};
};

/// Writes `key << 32 | position` for rays [begin, end).
void make_keys(const KeyMap& map, const FramedRay* framed, const std::uint32_t* faces, std::size_t begin,
               std::size_t end, std::uint64_t* keys);

}  // namespace gridreel::traversal
