#pragma once
// Bringing rays that start together and point alike next to each other.

#include "rebuild/buffer.h"
#include "traversal/ray_batch.h"

#include <cstdint>

namespace gridreel::traversal {

/// Orders the rays of a batch with a common origin by dominant axis, and by the Morton code of their slopes
/// within it. Keeps its memory. Parallel; the same order for any number of threads (ties keep the batch's
/// order).
class RaySort {
public:
    /// Fills `order` (resized) with the positions of all rays. Rays that hit nothing come last.
    void sort(const RayBatch& rays, rebuild::Buffer<std::uint32_t>& order);

private:
    rebuild::Buffer<std::uint64_t> keys_;  ///< key << 32 | ray
    rebuild::Buffer<std::uint64_t> sorted_;
};

}  // namespace gridreel::traversal
