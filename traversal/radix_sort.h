#pragma once
// A stable parallel sort for keys made of few bits.

#include "rebuild/buffer.h"

#include <cstdint>

namespace gridreel::traversal {

/// Sorts `items` by bits [32, 32 + key_bits), ascending; equal keys keep their order.
/// Scattered by their highest 11 bits first, in parallel; what then shares them is sorted in cache, bucket by
/// bucket, least significant digit first.
/// @param scratch  resized to hold as many items
/// @param key_bits in [0, 32]
void radix_sort(rebuild::Buffer<std::uint64_t>& items, rebuild::Buffer<std::uint64_t>& scratch,
                unsigned key_bits);

}  // namespace gridreel::traversal
