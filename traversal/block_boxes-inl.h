// Which blocks of a packet a triangle's box meets, all blocks at once. Included once per SIMD target.

#if defined(GRIDREEL_TRAVERSAL_BLOCK_BOXES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_TRAVERSAL_BLOCK_BOXES_INL_H_
#undef GRIDREEL_TRAVERSAL_BLOCK_BOXES_INL_H_
#else
#define GRIDREEL_TRAVERSAL_BLOCK_BOXES_INL_H_
#endif

#include "traversal/lanes-inl.h"
#include "traversal/packet.h"
#include "traversal/triangle-inl.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// A range divided into 255 steps. What lies outside counts as at its ends. Rounded as it may be, the step of
/// a greater value is never less: what overlaps does so in steps, too.
class Steps {
public:
    /// @param reach  from the range's middle, which is zero, to its ends
    explicit Steps(float reach)
        : per_unit_(last / std::clamp(reach, 0x1p-100f, std::numeric_limits<float>::max())) {}

    /// Of a value a lane.
    HWY_INLINE void store(Lanes values, std::int8_t* to) const {
        // Between 2^23 and 2^24 floats are whole numbers, and their lower bits those of the step.
        constexpr float whole = 0x1.8p23f;
        const LaneTag d;
        const hn::RebindToUnsigned<LaneTag> du;
        const hn::Rebind<std::uint8_t, LaneTag> du8;
        const Lanes along = hn::Mul(values, hn::Set(d, per_unit_));
        const Lanes within = hn::Min(hn::Max(along, hn::Set(d, -last)), hn::Set(d, last));
        const auto steps = hn::BitCast(du, hn::Add(within, hn::Set(d, whole)));
        hn::StoreU(hn::TruncateTo(du8, steps), du8, reinterpret_cast<std::uint8_t*>(to));
    }

private:
    static constexpr float last = 127.0f;
    float per_unit_;
};

/// The hull of the active blocks: slopes within centre +- half, depths that can still matter.
struct Hull {
    float centre_u = 0.0f, half_u = 0.0f, centre_v = 0.0f, half_v = 0.0f;
    float near_depth = 0.0f, far_depth = -1.0f;

    /// What triangles are seen along.
    [[nodiscard]] HWY_INLINE Slopes<Lanes> centre(LaneTag d) const {
        return {hn::Set(d, centre_u), hn::Set(d, centre_v)};
    }
};

/// The boxes of 16 triangles, in steps.
struct alignas(64) StepTable {
    std::int8_t low_u[group], high_u[group], low_v[group], high_v[group];
};

/// The blocks as a triangle's box meets them, in steps of the frustum: a byte holds a bound well enough to
/// cull by, and so few compares do for all blocks.
class alignas(64) BlockBoxes {
public:
    BlockBoxes(const Packet& packet, const Hull& hull) : u_(hull.half_u), v_(hull.half_v) {
        const LaneTag d;
        const Slopes<Lanes> aim = hull.centre(d);
        for (std::size_t first = 0; first < blocks_per_packet; first += hn::Lanes(d)) {
            const Lanes u = hn::Sub(hn::Load(d, packet.centre_u + first), aim.u);
            const Lanes v = hn::Sub(hn::Load(d, packet.centre_v + first), aim.v);
            const Lanes half_u = hn::Load(d, packet.half_u + first);
            const Lanes half_v = hn::Load(d, packet.half_v + first);
            u_.store(hn::Sub(u, half_u), low_u_ + first);
            u_.store(hn::Add(u, half_u), high_u_ + first);
            v_.store(hn::Sub(v, half_v), low_v_ + first);
            v_.store(hn::Add(v, half_v), high_v_ + first);
        }
    }

    /// Of the triangles from `first` on.
    HWY_INLINE void store_steps(const SlopeBox<Lanes>& box, std::size_t first, StepTable& table) const {
        u_.store(box.low_u, table.low_u + first);
        u_.store(box.high_u, table.high_u + first);
        v_.store(box.low_v, table.low_v + first);
        v_.store(box.high_v, table.high_v + first);
    }

    /// @param depth_min  of the triangle
    /// @return a bit for each block whose box overlaps the triangle's, and whose rays reach as far
    [[nodiscard]] HWY_INLINE BlockMask touched_by(const StepTable& table, int triangle, float depth_min,
                                                  const Packet& packet) const {
        const hn::CappedTag<std::int8_t, blocks_per_packet> d8;
        const auto low_u = hn::Set(d8, table.low_u[triangle]), high_u = hn::Set(d8, table.high_u[triangle]);
        const auto low_v = hn::Set(d8, table.low_v[triangle]), high_v = hn::Set(d8, table.high_v[triangle]);
        BlockMask apart = 0, in_reach = 0;
        for (std::size_t first = 0; first < blocks_per_packet; first += hn::Lanes(d8)) {
            const auto apart_u = hn::Or(hn::Gt(low_u, hn::Load(d8, high_u_ + first)),
                                        hn::Lt(high_u, hn::Load(d8, low_u_ + first)));
            const auto apart_v = hn::Or(hn::Gt(low_v, hn::Load(d8, high_v_ + first)),
                                        hn::Lt(high_v, hn::Load(d8, low_v_ + first)));
            apart |= BlockMask{bits_of(d8, hn::Or(apart_u, apart_v))} << first;
        }
        const LaneTag d;
        const Lanes nearest = hn::Set(d, depth_min);
        for (std::size_t first = 0; first < blocks_per_packet; first += hn::Lanes(d)) {
            in_reach |= BlockMask{bits_of(d, hn::Le(nearest, hn::Load(d, packet.far_depth + first)))}
                        << first;
        }
        return in_reach & ~apart;
    }

private:
    Steps u_, v_;
    alignas(64) std::int8_t low_u_[blocks_per_packet], high_u_[blocks_per_packet], low_v_[blocks_per_packet],
        high_v_[blocks_per_packet];
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
