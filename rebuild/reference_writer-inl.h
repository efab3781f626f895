// Cells of triangles, written one register after the other. Included once per SIMD target.

#if defined(GRIDREEL_REBUILD_REFERENCE_WRITER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_REBUILD_REFERENCE_WRITER_INL_H_
#undef GRIDREEL_REBUILD_REFERENCE_WRITER_INL_H_
#else
#define GRIDREEL_REBUILD_REFERENCE_WRITER_INL_H_
#endif

#include "rebuild/reference_kernel.h"

#include <hwy/highway.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::rebuild {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Whole numbers in [0, 2^22] as integers: `ConvertTo` would take care of larger ones, for twice the price.
template <class D>
HWY_INLINE hn::Vec<hn::RebindToUnsigned<D>> small_whole(D d, hn::Vec<D> number) {
    const hn::RebindToUnsigned<D> du;
    constexpr float bias = 0x1p23f;  // from here on a float's last bit counts ones
    return hn::And(hn::BitCast(du, hn::Add(number, hn::Set(d, bias))), hn::Set(du, (1u << 23) - 1u));
}

/// A box of cells; the fourth lane means nothing.
struct LaneRange {
    HWY_ALIGN std::uint32_t first[4];
    HWY_ALIGN std::uint32_t others[4];  ///< how many follow the first along each axis

    [[nodiscard]] HWY_INLINE std::size_t across(std::size_t axis) const {
        return std::size_t{1} + others[axis];
    }
};

/// From cells along each axis to numbers of cells, x fastest.
class CellStrides {
public:
    explicit CellStrides(const glm::ivec3& resolution)
        : stride_{1, static_cast<std::uint32_t>(resolution.x),
                  static_cast<std::uint32_t>(resolution.x) * static_cast<std::uint32_t>(resolution.y)} {}

    [[nodiscard]] HWY_INLINE std::uint32_t of(std::size_t axis) const { return stride_[axis]; }
    [[nodiscard]] HWY_INLINE std::uint32_t cell(const std::uint32_t* at) const {
        return at[0] + at[1] * stride_[1] + at[2] * stride_[2];
    }

private:
    std::uint32_t stride_[3];
};

/// Writes while there is room, and goes on counting when there is none.
class ReferenceWriter {
public:
    explicit ReferenceWriter(const ReferenceRoom& room) : room_(room) {}

    /// References so far: all are written if this is at most `capacity`.
    [[nodiscard]] HWY_INLINE std::size_t count() const { return count_; }

    /// Where to write the next cells, `ReferenceRoom::padding` of them whatever there is room for.
    [[nodiscard]] HWY_INLINE std::uint32_t* next() const {
        return room_.cells + std::min(count_, room_.capacity);
    }
    HWY_INLINE void advance(std::size_t references) { count_ += references; }

    /// All references from number `begin` on are of this triangle. Without a branch: those of a triangle
    /// without any are overwritten.
    HWY_INLINE void name_triangle(std::size_t begin, std::uint32_t triangle) {
        room_.cells[std::min(begin, room_.capacity)] |= next_triangle;
        room_.triangles[triangles_] = triangle;
        triangles_ += count_ > begin;
    }

private:
    ReferenceRoom room_;
    std::size_t count_ = 0;
    std::size_t triangles_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::rebuild
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
