#include "traversal/ray_sort.h"

#include "traversal/hilbert_curve.h"
#include "traversal/radix_sort.h"
#include "traversal/ray_sort_kernel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>

namespace gridreel::traversal {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t grain = 1 << 13;

/// Faces that occur, one after the other; the rays that hit nothing behind them.
/// @param key_bits  set to the bits that the keys take
KeyMap key_map(const FaceBounds& bounds, unsigned& key_bits) {
    KeyMap map;
    std::uint32_t used_faces = 0;
    for (std::size_t face = 0; face < face_count; ++face) {
        const SlopeBounds& box = bounds[face];
        if (box.empty()) continue;
        // One scale for both axes, so that the curve's squares are squares of slopes.
        const float extent = std::max({box.high_u - box.low_u, box.high_v - box.low_v, 1e-30f});
        map.first[face] = used_faces++ * hilbert_length;
        map.low_u[face] = box.low_u;
        map.low_v[face] = box.low_v;
        map.scale[face] = static_cast<float>(hilbert_side - 1) / extent;
    }
    map.first[face_count] = used_faces * hilbert_length;
    key_bits = 2 * hilbert_levels + static_cast<unsigned>(std::bit_width(used_faces));
    return map;
}

}  // namespace

const SortedRays& RaySort::sort(const RayBatch& rays) {
    const std::size_t count = rays.size();
    sorted_.framed.resize(count);
    faces_.resize(count);
    const FaceBounds bounds = tbb::parallel_reduce(
        Range(0, count, grain), FaceBounds{},
        [&](const Range& range, FaceBounds sum) {
            const FaceBounds found =
                frame_rays(rays, range.begin(), range.end(), sorted_.framed.data(), faces_.data());
            for (std::size_t face = 0; face < face_count; ++face) sum[face].extend(found[face]);
            return sum;
        },
        [](FaceBounds a, const FaceBounds& b) {
            for (std::size_t face = 0; face < face_count; ++face) a[face].extend(b[face]);
            return a;
        });

    unsigned key_bits = 0;
    const KeyMap map = key_map(bounds, key_bits);
    keys_.resize(count);
    tbb::parallel_for(Range(0, count, grain), [&](const Range& range) {
        make_keys(map, sorted_.framed.data(), faces_.data(), range.begin(), range.end(), keys_.data());
    });
    radix_sort(keys_, scratch_, key_bits);
    sorted_.order.resize(count);
    tbb::parallel_for(Range(0, count, grain), [&](const Range& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            sorted_.order[i] = static_cast<std::uint32_t>(keys_[i]);
    });

    // Where each face begins.
    std::size_t begin = 0;
    for (std::size_t face = 0; face <= face_count; ++face) {
        const auto first_behind = std::partition_point(sorted_.order.begin() + begin, sorted_.order.end(),
                                                       [&](std::uint32_t ray) { return faces_[ray] < face; });
        begin = static_cast<std::size_t>(first_behind - sorted_.order.begin());
        sorted_.face_begin[face] = begin;
    }
    return sorted_;
}

}  // namespace gridreel::traversal
