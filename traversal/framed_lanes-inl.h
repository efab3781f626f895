// `ray_frame`, a ray a lane. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_FRAMED_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_FRAMED_LANES_INL_H_
#undef GRIDREEL_TRAVERSAL_FRAMED_LANES_INL_H_
#else
#define GRIDREEL_TRAVERSAL_FRAMED_LANES_INL_H_
#endif

#include "rebuild/triangle_view.h"
#include "traversal/lanes-inl.h"
#include "traversal/ray_batch.h"
#include "traversal/ray_frame.h"

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// As `RayFrame`, the same bits.
struct FramedLanes {
    Lanes slope_u, slope_v, depth_per_t, depth_min, depth_max;
    Lanes face;  ///< `Axes::face`, or `face_count` of a ray that hits nothing
};

HWY_INLINE FramedLanes frame_lanes(Lanes x, Lanes y, Lanes z, Lanes t_min, Lanes t_max) {
    const LaneTag d;
    const Lanes zero = hn::Zero(d);
    const Lanes size_x = hn::Abs(x), size_y = hn::Abs(y), size_z = hn::Abs(z);
    const auto k_is_x = hn::And(hn::Ge(size_x, size_y), hn::Ge(size_x, size_z));
    const auto k_is_y = hn::AndNot(k_is_x, hn::Ge(size_y, size_z));
    const auto of_axes = [&](Lanes for_x, Lanes for_y, Lanes for_z) {
        return hn::IfThenElse(k_is_x, for_x, hn::IfThenElse(k_is_y, for_y, for_z));
    };
    const Lanes along = of_axes(x, y, z);
    FramedLanes rays;
    rays.depth_per_t = hn::Abs(along);
    rays.slope_u = hn::Div(of_axes(y, z, x), rays.depth_per_t);
    rays.slope_v = hn::Div(of_axes(z, x, y), rays.depth_per_t);
    rays.depth_min = hn::Mul(hn::Max(t_min, zero), rays.depth_per_t);
    rays.depth_max = hn::Mul(t_max, rays.depth_per_t);

    const auto finite = hn::Lt(hn::Add(hn::Add(size_x, size_y), size_z), hn::Inf(d));
    const auto alive = hn::And(hn::And(finite, hn::Gt(rays.depth_per_t, zero)),
                               hn::And(hn::Lt(t_min, t_max), hn::Lt(rays.depth_min, rays.depth_max)));
    const Lanes upwards = of_axes(zero, hn::Set(d, 2.0f), hn::Set(d, 4.0f));
    const Lanes downwards = hn::IfThenElseZero(hn::Lt(along, zero), hn::Set(d, 1.0f));
    rays.face =
        hn::IfThenElse(alive, hn::Add(upwards, downwards), hn::Set(d, static_cast<float>(face_count)));
    return rays;
}

/// Of rays with a common direction, what is left to each.
struct ParallelLanes {
    Lanes k, u, v;  ///< origins, in the frame's axes
    Lanes depth_min, depth_max;
    hn::Mask<LaneTag> alive;  ///< can hit something
};

/// @param frame  of all the rays (`frame_of_parallel`)
/// @param read   `read(values)`: of each lane's ray
template <class Read>
HWY_INLINE ParallelLanes parallel_lanes(const RayBatch& rays, const RayFrame& frame, const Read& read) {
    const LaneTag d;
    const auto origin = [&](int axis) HWY_ATTR { return read(rays.origin[static_cast<std::size_t>(axis)]); };
    const auto traceable = [&](Lanes coordinate) HWY_ATTR {
        return hn::Le(hn::Abs(coordinate), hn::Set(d, rebuild::largest_coordinate));
    };
    const Lanes t_min = read(rays.t_min), t_max = read(rays.t_max);
    const Lanes depth_per_t = hn::Set(d, frame.depth_per_t);
    ParallelLanes lanes;
    lanes.k = origin(frame.axes.k);
    lanes.u = origin(frame.axes.u());
    lanes.v = origin(frame.axes.v());
    lanes.depth_min = hn::Mul(hn::Max(t_min, hn::Zero(d)), depth_per_t);
    lanes.depth_max = hn::Mul(t_max, depth_per_t);
    const auto in_order = hn::And(hn::Lt(t_min, t_max), hn::Lt(lanes.depth_min, lanes.depth_max));
    lanes.alive =
        hn::And(in_order, hn::And(traceable(lanes.k), hn::And(traceable(lanes.u), traceable(lanes.v))));
    return lanes;
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
