// Rows of four values to a vector for each column. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_TRANSPOSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_TRANSPOSE_INL_H_
#undef GRIDREEL_TRAVERSAL_TRANSPOSE_INL_H_
#else
#define GRIDREEL_TRAVERSAL_TRANSPOSE_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The first three of each row's four values, a row a lane.
/// @param row  `row(i)`: of the lane, as four floats; asked for up to eight
template <class D, class Row, class V = hn::Vec<D>>
HWY_INLINE void transpose_rows(D d, const Row& row, V* axis) {
    const hn::Repartition<double, D> pairs;
    V r[4];
    for (std::size_t i = 0; i < 4; ++i) {
        if constexpr (hn::MaxLanes(D()) == 8) {
            r[i] = hn::Combine(d, row(i + 4), row(i));
        } else {
            r[i] = row(i);
        }
    }
    const V low01 = hn::InterleaveLower(d, r[0], r[1]), low23 = hn::InterleaveLower(d, r[2], r[3]);
    const V high01 = hn::InterleaveUpper(d, r[0], r[1]), high23 = hn::InterleaveUpper(d, r[2], r[3]);
    const auto halves = [&](const V& v) HWY_ATTR { return hn::BitCast(pairs, v); };
    axis[0] = hn::BitCast(d, hn::InterleaveLower(pairs, halves(low01), halves(low23)));
    axis[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, halves(low01), halves(low23)));
    axis[2] = hn::BitCast(d, hn::InterleaveLower(pairs, halves(high01), halves(high23)));
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
