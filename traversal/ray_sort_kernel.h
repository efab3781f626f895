#pragma once
// The inner loop of sorting rays, chosen for the machine's SIMD instructions at run time.

#include "traversal/ray_sort.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

inline constexpr std::size_t rays_per_register = 16;  ///< at most

/// The slopes that occur on one face of the cube of directions; low > high where there are none.
struct SlopeBounds {
    float low_u = 2.0f, high_u = -2.0f, low_v = 2.0f, high_v = -2.0f;

    [[nodiscard]] bool empty() const { return low_u > high_u; }
    void extend(float u, float v);
};
using FaceBounds = std::array<SlopeBounds, face_count>;

/// From slopes to keys: `(slope - low[face]) * scale[face]` is a cell of the curve's square.
struct KeyMap {
    std::array<float, face_count + 1> low_u{}, low_v{}, scale{};

    explicit KeyMap(const FaceBounds& bounds);
};

/// Frames rays [begin, end) of a batch, the same bits as `ray_frame`, and makes their keys.
/// @param begin         a multiple of `rays_per_register`; so is `end`, unless it is the batch's
/// @param framed, keys  of the whole batch
void frame_rays(const RayBatch& rays, std::size_t begin, std::size_t end, const KeyMap& map,
                FramedRay* framed, std::uint64_t* keys);

[[nodiscard]] inline std::size_t bucket_of(std::uint64_t key) {
    return key >> (32 + RayKey::low_bits);
}

}  // namespace gridreel::traversal
