// The lanes that kernels work in. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_LANES_INL_H_
#undef GRIDREEL_TRAVERSAL_LANES_INL_H_
#else
#define GRIDREEL_TRAVERSAL_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Whether a walk looks for each ray's nearest hit, or for any.
enum class Wanted { closest, any };

/// Lanes are triangles, blocks or rays, 16 of each: one, two or four registers.
inline constexpr std::size_t group = 16;
using LaneTag = hn::CappedTag<float, group>;
using Lanes = hn::Vec<LaneTag>;

/// Bits of a mask of up to 16 lanes.
HWY_INLINE unsigned bits_of(LaneTag d, hn::Mask<LaneTag> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return static_cast<unsigned>(bytes[0]) | static_cast<unsigned>(bytes[1]) << 8;
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
