#pragma once
// Numbers of the things in a scene.

#include <cstdint>

namespace gridreel::anim {

using Index = std::uint32_t;  ///< into one of the vectors of `Scene`

}  // namespace gridreel::anim
