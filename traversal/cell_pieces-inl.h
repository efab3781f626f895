// Which triangles of a cell a ray comes near. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_
#undef GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_
#else
#define GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_
#endif

#include "traversal/reference_boxes.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A ray's way through a cell, in a few pieces, each with its own box: a ray that crosses the cell aslant has
/// it all as its box, but its pieces do not.
///
/// A piece is what `ReferenceBox` is held against, eight bytes: the greatest places along x, y and z, and
/// what the least ones lack to 255; so a triangle lies apart from a piece if any of its bytes is the greater.
inline constexpr std::size_t piece_count = 4;

/// The pieces of as many rays as there are lanes, the first and the last four bytes of each.
template <class D>
struct PieceHalves {
    hn::Vec<hn::RebindToUnsigned<D>> first[piece_count], last[piece_count];
};

/// @param begin, end  `CellPlace` of the ray's way on x, y and z, not held within 0 and 255
template <class D, class V = hn::Vec<D>>
HWY_INLINE PieceHalves<D> cut_in_pieces(D d, const V* begin, const V* end) {
    const hn::RebindToSigned<D> di;
    const hn::RebindToUnsigned<D> du;
    PieceHalves<D> pieces;
    for (std::size_t i = 0; i < piece_count; ++i) {
        pieces.first[i] = hn::Set(du, 0xff000000u);
        pieces.last[i] = hn::Zero(du);
    }
    const auto put = [&]<int axis>(std::integral_constant<int, axis>) HWY_ATTR {
        // The triangles' boxes are wide enough for what is rounded here.
        const auto whole = [&](V p) HWY_ATTR {
            return hn::ConvertTo(di, hn::Min(hn::Max(p, hn::Zero(d)), hn::Set(d, 255.0f)));
        };
        const V way = hn::Sub(end[axis], begin[axis]);
        auto from = whole(begin[axis]);
        for (std::size_t i = 0; i < piece_count; ++i) {
            const V part = hn::Set(d, static_cast<float>(i + 1) / float(piece_count));
            const auto to = whole(hn::MulAdd(part, way, begin[axis]));
            const auto byte = [&](auto place)
                                  HWY_ATTR { return hn::ShiftLeft<8 * axis>(hn::BitCast(du, place)); };
            pieces.first[i] = hn::Or(pieces.first[i], byte(hn::Max(from, to)));
            pieces.last[i] = hn::Or(pieces.last[i], byte(hn::Min(from, to)));
            from = to;
        }
    };
    put(std::integral_constant<int, 0>());
    put(std::integral_constant<int, 1>());
    put(std::integral_constant<int, 2>());
    for (std::size_t i = 0; i < piece_count; ++i) pieces.last[i] = hn::Not(pieces.last[i]);
    return pieces;
}

/// Boxes that `near_boxes` looks at in one pass.
inline constexpr std::size_t boxes_at_a_time = hn::MaxLanes(hn::CappedTag<std::uint64_t, 8>());

/// @param pieces  `piece_count` of one ray
/// @return a bit for each of `boxes_at_a_time` that a piece touches
HWY_INLINE unsigned near_boxes(const ReferenceBox* boxes, const std::uint64_t* pieces) {
    const hn::CappedTag<std::uint64_t, 8> d;
    const hn::Repartition<std::uint8_t, decltype(d)> bytes;
    const auto read = hn::LoadU(bytes, reinterpret_cast<const std::uint8_t*>(boxes));
    const auto touches = [&](std::size_t i) HWY_ATTR {
        const auto piece = hn::BitCast(bytes, hn::Set(d, pieces[i]));
        return hn::Eq(hn::BitCast(d, hn::SaturatedSub(read, piece)), hn::Zero(d));
    };
    static_assert(piece_count == 4);
    const auto any = hn::Or(hn::Or(touches(0), touches(1)), hn::Or(touches(2), touches(3)));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, any, bits);
    return bits[0];
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
