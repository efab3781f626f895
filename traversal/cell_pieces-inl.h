// Which triangles of a cell a ray comes near. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_
#undef GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_
#else
#define GRIDREEL_TRAVERSAL_CELL_PIECES_INL_H_
#endif

#include "traversal/ray_walk.h"
#include "traversal/reference_boxes.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Where a ray runs within the cells of one grid, in `CellPlace` numbered on from cell to cell.
class RayPlaces {
public:
    HWY_INLINE RayPlaces(const rebuild::UniformGrid& grid, const RayLine& line) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double per_metre = double(CellPlace::per_cell) / grid.cell_size[axis];
            per_depth_[i] = line.slope[axis] * per_metre;
            at_zero_[i] = (line.origin[axis] - double(grid.bounds.min[axis])) * per_metre;
            last_[i] = grid.resolution[axis] - 1;
        }
    }

    /// Place in the cell that has `steps_left` as `WalkStart`.
    [[nodiscard]] HWY_INLINE float place(std::size_t axis, std::uint64_t steps_left, double depth) const {
        const auto left = static_cast<int>(steps_left >> (21 * axis) & 0xffff);
        const int cell = per_depth_[axis] > 0.0 ? last_[axis] - left : left;
        return static_cast<float>(at_zero_[axis] + depth * per_depth_[axis] -
                                  double(CellPlace::per_cell) * cell) +
               CellPlace::cell_begin;
    }

private:
    std::array<double, 3> per_depth_, at_zero_;
    std::array<int, 3> last_;
};

/// A ray's way through a cell, in a few pieces, each with its own box: a ray that crosses the cell aslant has
/// it all as its box, but its pieces do not.
class CellPieces {
public:
    static constexpr std::size_t width = 32;  ///< triangles at a time

    /// @param from, to  depths
    HWY_INLINE CellPieces(const RayPlaces& ray, std::uint64_t steps_left, double from, double to) {
        const D d;
        const hn::RebindToSigned<D> di;
        HWY_ALIGN static constexpr float parts[5] = {0.0f, 0.25f, 0.5f, 0.75f, 1.0f};
        const auto greatest = hn::Set(d, 255.0f);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float begin = ray.place(axis, steps_left, from);
            const float end = ray.place(axis, steps_left, to);
            const auto way = hn::Set(d, end - begin);
            const auto a = hn::MulAdd(hn::LoadU(d, parts), way, hn::Set(d, begin));
            const auto b = hn::MulAdd(hn::LoadU(d, parts + 1), way, hn::Set(d, begin));
            // The triangles' boxes are wide enough for what is rounded here.
            const auto whole = [&](hn::Vec<D> p) HWY_ATTR {
                return hn::ConvertTo(di, hn::Min(hn::Max(p, hn::Zero(d)), greatest));
            };
            hn::Store(whole(hn::Min(a, b)), di, low_[axis]);
            hn::Store(whole(hn::Max(a, b)), di, high_[axis]);
        }
    }

    /// @return a bit for each of `width` boxes from `first` on that a piece touches
    [[nodiscard]] HWY_INLINE std::uint32_t near(const ReferenceBoxes::Level& boxes, std::size_t first) const {
        const hn::CappedTag<std::uint8_t, width> d;
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
            const auto read = [&](const std::array<const std::uint8_t*, 3>& of, std::size_t axis)
                                  HWY_ATTR { return hn::LoadU(d, of[axis] + first + i); };
            const auto low_x = read(boxes.low, 0), low_y = read(boxes.low, 1), low_z = read(boxes.low, 2);
            const auto high_x = read(boxes.high, 0), high_y = read(boxes.high, 1),
                       high_z = read(boxes.high, 2);
            auto apart = hn::Set(d, std::uint8_t{255});
            for (std::size_t piece = 0; piece < pieces; ++piece) {
                const auto gap = [&](auto low, auto high, std::size_t axis) HWY_ATTR {
                    return hn::Or(
                        hn::SaturatedSub(low, hn::Set(d, static_cast<std::uint8_t>(high_[axis][piece]))),
                        hn::SaturatedSub(hn::Set(d, static_cast<std::uint8_t>(low_[axis][piece])), high));
                };
                apart = hn::Min(apart, hn::Or(gap(low_x, high_x, 0),
                                              hn::Or(gap(low_y, high_y, 1), gap(low_z, high_z, 2))));
            }
            std::uint8_t bytes[8] = {};
            hn::StoreMaskBits(d, hn::Eq(apart, hn::Zero(d)), bytes);
            for (std::size_t byte = 0; byte < hn::Lanes(d) / 8; ++byte) {
                bits |= std::uint32_t{bytes[byte]} << (i + 8 * byte);
            }
        }
        return bits;
    }

private:
    static constexpr std::size_t pieces = 4;
    using D = hn::FixedTag<float, pieces>;

    HWY_ALIGN std::int32_t low_[3][pieces], high_[3][pieces];
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
