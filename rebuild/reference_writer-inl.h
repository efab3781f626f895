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

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::rebuild {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A box of cells, both ends included; the fourth lane means nothing.
struct LaneRange {
    HWY_ALIGN std::int32_t first[4];
    HWY_ALIGN std::int32_t last[4];

    [[nodiscard]] HWY_INLINE std::size_t across(std::size_t axis) const {
        return static_cast<std::size_t>(last[axis] - first[axis]) + 1;
    }
};

/// From cells along each axis to numbers of cells, x fastest.
class CellStrides {
public:
    explicit CellStrides(const glm::ivec3& resolution)
        : stride_{1, static_cast<std::uint32_t>(resolution.x),
                  static_cast<std::uint32_t>(resolution.x) * static_cast<std::uint32_t>(resolution.y)} {}

    [[nodiscard]] HWY_INLINE std::uint32_t of(std::size_t axis) const { return stride_[axis]; }
    [[nodiscard]] HWY_INLINE std::uint32_t cell(const std::int32_t* at) const {
        return static_cast<std::uint32_t>(at[0]) + static_cast<std::uint32_t>(at[1]) * stride_[1] +
               static_cast<std::uint32_t>(at[2]) * stride_[2];
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

    /// Writes a register of cells, at most 16 behind the references so far; `advance` says what counts.
    template <class D>
    HWY_INLINE void put(D d, std::size_t behind, hn::Vec<D> cells) {
        if (HWY_LIKELY(count_ <= room_.capacity)) hn::StoreU(cells, d, room_.cells + count_ + behind);
    }
    HWY_INLINE void advance(std::size_t references) { count_ += references; }

    /// All references from number `begin` on are of this triangle.
    HWY_INLINE void name_triangle(std::size_t begin, std::uint32_t triangle) {
        if (HWY_UNLIKELY(count_ > room_.capacity)) return;
        const hn::FixedTag<std::uint32_t, 4> d;
        const auto name = hn::Set(d, triangle);
        std::size_t k = begin;
        do {
            hn::StoreU(name, d, room_.triangles + k);
            hn::StoreU(name, d, room_.triangles + k + 4);
            k += 8;
        } while (HWY_UNLIKELY(k < count_));
    }

private:
    ReferenceRoom room_;
    std::size_t count_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::rebuild
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
