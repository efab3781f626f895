// A position in four lanes. Included once per SIMD target.

#if defined(GRIDREEL_REBUILD_READ_POSITION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef GRIDREEL_REBUILD_READ_POSITION_INL_H_
#undef GRIDREEL_REBUILD_READ_POSITION_INL_H_
#else
#define GRIDREEL_REBUILD_READ_POSITION_INL_H_
#endif

#include <hwy/highway.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

HWY_BEFORE_NAMESPACE();
namespace gridreel::rebuild {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using FourTag = hn::FixedTag<float, 4>;
using Four = hn::Vec<FourTag>;

/// Reads positions whole, x y z and a fourth lane that means nothing, but nothing behind the last of them.
class PositionReader {
public:
    /// @param positions  at least one
    explicit PositionReader(std::span<const glm::vec3> positions)
        : positions_(positions.data()), last_(static_cast<std::uint32_t>(positions.size() - 1)) {}

    [[nodiscard]] HWY_INLINE Four at(std::uint32_t vertex) const {
        const FourTag d;
        const float* point = &positions_[vertex].x;
        if (HWY_LIKELY(vertex != last_)) return hn::LoadU(d, point);
        HWY_ALIGN const float copy[4] = {point[0], point[1], point[2], 0.0f};
        return hn::Load(d, copy);
    }

private:
    const glm::vec3* positions_;
    std::uint32_t last_;
};

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::rebuild
HWY_AFTER_NAMESPACE();

#endif  // toggled include guard
