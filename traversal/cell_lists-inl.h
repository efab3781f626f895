// Lists of triangles of a few cells, copied side by side. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_CELL_LISTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_CELL_LISTS_INL_H_
#undef GRIDREEL_TRAVERSAL_CELL_LISTS_INL_H_
#else
#define GRIDREEL_TRAVERSAL_CELL_LISTS_INL_H_
#endif

#include "rebuild/grid.h"
#include "traversal/lanes-inl.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Most cells list a few triangles or none, and how many is as good as random: lists are copied 16 entries at
/// a time, whatever their length, and looked at together.
class CellLists {
public:
    static constexpr std::size_t capacity = 256;
    static_assert(group <= rebuild::Buffer<std::uint32_t>::padding);

    /// Copies references [begin, end), as far as there is room and no nested grid among them.
    /// @return where it stopped
    HWY_INLINE std::uint32_t take(const rebuild::GridLevel& level, std::uint32_t begin, std::uint32_t end) {
        const hn::RebindToUnsigned<LaneTag> du;
        const std::uint32_t* const references = level.references.data();
        while (count_ <= capacity) {
            const std::size_t some = std::min<std::size_t>(end - begin, group);
            // Of empty cells nothing is read, lest it be waited for: what is in cache will do as well.
            const std::uint32_t* const list = some == 0 ? lists_ : references + begin;
            unsigned marks = 0;
            for (std::size_t i = 0; i < group; i += hn::Lanes(du)) {
                const auto values = hn::LoadU(du, list + i);
                hn::StoreU(values, du, lists_ + count_ + i);
                const auto marked = hn::TestBit(values, hn::Set(du, rebuild::nested_mark));
                marks |= bits_of(LaneTag(), hn::RebindMask(LaneTag(), marked)) << i;
            }
            marks &= (1u << some) - 1;
            if (HWY_UNLIKELY(marks != 0)) {
                const auto before = static_cast<std::uint32_t>(std::countr_zero(marks));
                count_ += before;
                return begin + before;
            }
            count_ += some;
            begin += static_cast<std::uint32_t>(some);
            if (HWY_LIKELY(begin == end)) break;
        }
        return begin;
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const std::uint32_t* begin() const { return lists_; }
    [[nodiscard]] const std::uint32_t* end() const { return lists_ + count_; }
    void clear() { count_ = 0; }

private:
    std::size_t count_ = 0;
    std::uint32_t lists_[capacity + group];
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
