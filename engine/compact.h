#pragma once
// Picking the marked ones of many.

#include "rebuild/buffer.h"

#include <cstdint>

namespace gridreel::engine {

/// The indices of all non-zero `marks`, ascending. In parallel; the same for any number of threads.
/// @param marks  at most 2^32 - 1
void compact(const rebuild::Buffer<std::uint8_t>& marks, rebuild::Buffer<std::uint32_t>& indices);

}  // namespace gridreel::engine
