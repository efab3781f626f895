// From three floats a vertex to one register a component, and back. Included once per SIMD target.

#if defined(GRIDREEL_ANIM_PACKED_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_ANIM_PACKED_VECTORS_INL_H_
#undef GRIDREEL_ANIM_PACKED_VECTORS_INL_H_
#else
#define GRIDREEL_ANIM_PACKED_VECTORS_INL_H_
#endif

#include "anim/lane_vectors-inl.h"

#include <hwy/highway.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace gridreel::anim {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Loads and stores `lane_count` packed vectors.
///
/// Three registers hold them. Component c stands at every third lane of each, and since three does not divide
/// the number of lanes, at other lanes in each register: two selections collect it, and one permutation puts
/// it in order. That is half of what LoadInterleaved3 takes.
class PackedVectors {
public:
    HWY_INLINE PackedVectors()
        : third0_(hn::Eq(remainders(), hn::Zero(Tag()))),
          third1_(hn::Eq(remainders(), hn::Set(Tag(), 1.0f))),
          unpack_{unpacking(0), unpacking(1), unpacking(2)},
          pack_{packing(0), packing(1), packing(2)} {}

    [[nodiscard]] HWY_INLINE LaneVector load(const glm::vec3* vectors) const {
        const Tag d;
        const float* const from = &vectors->x;
        const Lanes a = hn::LoadU(d, from), b = hn::LoadU(d, from + lane_count),
                    c = hn::LoadU(d, from + 2 * lane_count);
        if constexpr (lane_count % 3 == 1) {
            return {hn::TableLookupLanes(select(a, c, b), unpack_.x),
                    hn::TableLookupLanes(select(b, a, c), unpack_.y),
                    hn::TableLookupLanes(select(c, b, a), unpack_.z)};
        } else {
            return {hn::TableLookupLanes(select(a, b, c), unpack_.x),
                    hn::TableLookupLanes(select(c, a, b), unpack_.y),
                    hn::TableLookupLanes(select(b, c, a), unpack_.z)};
        }
    }

    HWY_INLINE void store(const LaneVector& v, glm::vec3* vectors) const {
        const Tag d;
        float* const to = &vectors->x;
        const Lanes x = hn::TableLookupLanes(v.x, pack_.x), y = hn::TableLookupLanes(v.y, pack_.y),
                    z = hn::TableLookupLanes(v.z, pack_.z);
        hn::StoreU(select(x, y, z), d, to);
        if constexpr (lane_count % 3 == 1) {
            hn::StoreU(select(y, z, x), d, to + lane_count);
            hn::StoreU(select(z, x, y), d, to + 2 * lane_count);
        } else {
            hn::StoreU(select(z, x, y), d, to + lane_count);
            hn::StoreU(select(y, z, x), d, to + 2 * lane_count);
        }
    }

private:
    using Order = decltype(hn::SetTableIndices(Tag(), static_cast<const std::int32_t*>(nullptr)));
    struct Orders {
        Order x, y, z;
    };

    static HWY_INLINE Lanes remainders() {
        HWY_ALIGN std::array<float, lane_count> lanes;
        for (std::size_t i = 0; i < lane_count; ++i) lanes[i] = static_cast<float>(i % 3);
        return hn::Load(Tag(), lanes.data());
    }

    /// Where component c of each vector stands.
    static HWY_INLINE Order unpacking(std::size_t c) {
        HWY_ALIGN std::array<std::int32_t, lane_count> from;
        for (std::size_t i = 0; i < lane_count; ++i)
            from[i] = static_cast<std::int32_t>((3 * i + c) % lane_count);
        return hn::SetTableIndices(Tag(), from.data());
    }

    /// The other way round.
    static HWY_INLINE Order packing(std::size_t c) {
        HWY_ALIGN std::array<std::int32_t, lane_count> from;
        for (std::size_t i = 0; i < lane_count; ++i)
            from[(3 * i + c) % lane_count] = static_cast<std::int32_t>(i);
        return hn::SetTableIndices(Tag(), from.data());
    }

    /// Lanes 0, 3, ... of the first, 1, 4, ... of the second, 2, 5, ... of the third.
    [[nodiscard]] HWY_INLINE Lanes select(Lanes first, Lanes second, Lanes third) const {
        return hn::IfThenElse(third0_, first, hn::IfThenElse(third1_, second, third));
    }

    LaneMask third0_, third1_;
    Orders unpack_, pack_;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::anim
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
