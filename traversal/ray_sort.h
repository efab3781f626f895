#pragma once
// Bringing rays that start together and point alike next to each other.

#include "rebuild/buffer.h"
#include "traversal/ray_batch.h"
#include "traversal/ray_frame.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// What packets need of a ray whose frame's axes are known: 16 bytes, so that rays read in any order cost one
/// cache line each. Fields as in `RayFrame`.
struct alignas(16) FramedRay {
    float slope_u, slope_v, depth_min, depth_max;
};

/// The rays of a batch with a common origin, by dominant axis and along Hilbert's curve through their slopes
/// within it.
struct SortedRays {
    rebuild::Buffer<FramedRay> framed;     ///< one per ray, in the batch's order
    rebuild::Buffer<std::uint32_t> order;  ///< positions in the batch: face after face, then the dead
    /// Where each face's rays begin in `order`; the last entry is where the rays that hit nothing begin.
    std::array<std::size_t, face_count + 1> face_begin{};
};

/// Sorts batch after batch in the same memory. Parallel; the same order for any number of threads (ties keep
/// the batch's order).
class RaySort {
public:
    /// @return valid until the next call
    const SortedRays& sort(const RayBatch& rays);

private:
    SortedRays sorted_;
    rebuild::Buffer<std::uint32_t> faces_;  ///< `Axes::face`, or `face_count` of a ray that hits nothing
    rebuild::Buffer<std::uint64_t> keys_;   ///< key << 32 | position
    rebuild::Buffer<std::uint64_t> scratch_;
};

}  // namespace gridreel::traversal
