// The lanes that kernels work in. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_LANES_INL_H_
#undef GRIDREEL_TRAVERSAL_LANES_INL_H_
#else
#define GRIDREEL_TRAVERSAL_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

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

/// Bits of a mask of up to 32 lanes.
template <class D>
HWY_INLINE std::uint32_t bits_of(D d, hn::Mask<D> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    // Compilers do not see that bytes put together one by one are the register that they came from.
    static_assert(std::endian::native == std::endian::little);
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
