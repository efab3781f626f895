// A ray's walk through a grid without branches on its axes. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_LANE_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_LANE_WALK_INL_H_
#undef GRIDREEL_TRAVERSAL_LANE_WALK_INL_H_
#else
#define GRIDREEL_TRAVERSAL_LANE_WALK_INL_H_
#endif

#include "traversal/ray_walk.h"

#include <hwy/highway.h>

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Visits the cells that `RayWalk` visits. Which plane comes next is as good as random, so it is never
/// branched upon: a mispredicted branch takes longer than the step.
class LaneWalk {
    using Depth = hn::CappedTag<double, 1>;
    using Count = hn::RebindToSigned<Depth>;

public:
    HWY_INLINE explicit LaneWalk(const WalkStart& start)
        : inside_(start.inside),
          cell_(hn::Set(Count(), static_cast<std::int64_t>(start.cell))),
          steps_left_(hn::Set(Count(), static_cast<std::int64_t>(start.steps_left))) {
        for (std::size_t i = 0; i < 3; ++i) {
            next_[i] = hn::Set(Depth(), start.next_plane[i]);
            distance_[i] = hn::Set(Depth(), start.plane_distance[i]);
            stride_[i] = hn::Set(Count(), start.stride[i]);
            unit_[i] = hn::Set(Count(), static_cast<std::int64_t>(WalkStart::step_unit[i]));
        }
    }

    [[nodiscard]] HWY_INLINE bool inside() const { return inside_; }
    [[nodiscard]] HWY_INLINE std::size_t cell() const { return static_cast<std::size_t>(hn::GetLane(cell_)); }
    [[nodiscard]] HWY_INLINE std::uint64_t steps_left() const {
        return static_cast<std::uint64_t>(hn::GetLane(steps_left_));
    }
    [[nodiscard]] HWY_INLINE double exit_depth() const {
        return hn::GetLane(hn::Min(next_[0], hn::Min(next_[1], next_[2])));
    }

    HWY_INLINE void advance() {
        const Count di;
        const auto x = hn::Le(next_[0], hn::Min(next_[1], next_[2]));
        const auto y_before_z = hn::Le(next_[1], next_[2]);
        const auto y = hn::AndNot(x, y_before_z);
        const auto z = hn::Not(hn::Or(x, y_before_z));
        const auto of_axis = [&](const hn::Vec<Count>* values) HWY_ATTR {
            return hn::IfThenElse(hn::RebindMask(di, x), values[0],
                                  hn::IfThenElse(hn::RebindMask(di, y_before_z), values[1], values[2]));
        };
        cell_ = hn::Add(cell_, of_axis(stride_));
        steps_left_ = hn::Sub(steps_left_, of_axis(unit_));
        next_[0] = hn::Add(next_[0], hn::IfThenElseZero(x, distance_[0]));
        next_[1] = hn::Add(next_[1], hn::IfThenElseZero(y, distance_[1]));
        next_[2] = hn::Add(next_[2], hn::IfThenElseZero(z, distance_[2]));
        inside_ = (steps_left() & WalkStart::out_of_grid) == WalkStart::out_of_grid;
    }

private:
    bool inside_;
    hn::Vec<Count> cell_, steps_left_;
    hn::Vec<Depth> next_[3], distance_[3];
    hn::Vec<Count> stride_[3], unit_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
