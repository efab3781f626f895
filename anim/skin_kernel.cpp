#include "anim/skin_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "anim/skin_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <glm/gtc/type_ptr.hpp>

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::anim {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, SkinBlock::padding>;
using Lanes = hn::Vec<Tag>;
using RowTag = hn::CappedTag<float, 4>;
static_assert(hn::MaxLanes(RowTag()) == 4, "a row of a map is loaded at once");

struct LaneVector {
    Lanes x, y, z;
};

HWY_INLINE Lanes dot(const LaneVector& a, const LaneVector& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE LaneVector cross(const LaneVector& a, const LaneVector& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

/// One row of as many vertices' maps as there are lanes: the linear part, and the offset.
struct LaneRow {
    LaneVector linear;
    Lanes offset;
};

HWY_INLINE LaneRow load_row(const glm::vec4* rows) {
    LaneRow row;
    hn::LoadInterleaved4(Tag(), glm::value_ptr(*rows), row.linear.x, row.linear.y, row.linear.z, row.offset);
    return row;
}

HWY_INLINE LaneVector load(const glm::vec3* vectors) {
    LaneVector v;
    hn::LoadInterleaved3(Tag(), glm::value_ptr(*vectors), v.x, v.y, v.z);
    return v;
}

HWY_INLINE void store(const LaneVector& v, glm::vec3* vectors) {
    hn::StoreInterleaved3(v.x, v.y, v.z, Tag(), glm::value_ptr(*vectors));
}

/// At unit length, scaled before squaring so that tiny and huge vectors keep their direction; zero where
/// there is none.
HWY_INLINE LaneVector unit(const LaneVector& v) {
    const Tag d;
    const Lanes largest = hn::Max(hn::Abs(v.x), hn::Max(hn::Abs(v.y), hn::Abs(v.z)));
    const LaneVector scaled{hn::Div(v.x, largest), hn::Div(v.y, largest), hn::Div(v.z, largest)};
    const Lanes shrink = hn::Div(hn::Set(d, 1.0f), hn::Sqrt(dot(scaled, scaled)));
    // Not-a-numbers fail every comparison.
    const Lanes most = hn::Set(d, std::numeric_limits<float>::max());
    const auto is_finite = [&](Lanes a) HWY_ATTR { return hn::Le(hn::Abs(a), most); };
    const auto has_direction = hn::And(hn::And(is_finite(v.x), is_finite(v.y)),
                                       hn::And(is_finite(v.z), hn::Gt(largest, hn::Zero(d))));
    return {hn::IfThenElseZero(has_direction, hn::Mul(scaled.x, shrink)),
            hn::IfThenElseZero(has_direction, hn::Mul(scaled.y, shrink)),
            hn::IfThenElseZero(has_direction, hn::Mul(scaled.z, shrink))};
}

/// Every vertex's own map: the weighted sum of its joints'.
HWY_INLINE void blend(const AffineRows* rows, const std::uint16_t* joints, const float* weights,
                      std::size_t per_vertex, SkinBlock& block) {
    const RowTag d;
    for (std::size_t v = 0; v < block.count; ++v, joints += per_vertex, weights += per_vertex) {
        const auto of_joint = [&](std::size_t joint, glm::length_t row) HWY_ATTR {
            return hn::Mul(hn::Set(d, weights[joint]),
                           hn::LoadU(d, glm::value_ptr(rows[joints[joint]][row])));
        };
        auto a = of_joint(0, 0), b = of_joint(0, 1), c = of_joint(0, 2);
        for (std::size_t joint = 1; joint < per_vertex; ++joint) {
            a = hn::Add(a, of_joint(joint, 0));
            b = hn::Add(b, of_joint(joint, 1));
            c = hn::Add(c, of_joint(joint, 2));
        }
        hn::StoreU(a, d, glm::value_ptr(block.rows[0][v]));
        hn::StoreU(b, d, glm::value_ptr(block.rows[1][v]));
        hn::StoreU(c, d, glm::value_ptr(block.rows[2][v]));
    }
}

void skin(const AffineRows* rows, const std::uint16_t* joints, const float* weights, std::size_t per_vertex,
          const glm::vec3& origin, SkinBlock& block) {
    blend(rows, joints, weights, per_vertex, block);

    const Tag d;
    const LaneVector from{hn::Set(d, origin.x), hn::Set(d, origin.y), hn::Set(d, origin.z)};
    for (std::size_t v = 0; v < block.count; v += hn::Lanes(d)) {
        const LaneRow a = load_row(&block.rows[0][v]), b = load_row(&block.rows[1][v]),
                      c = load_row(&block.rows[2][v]);

        const LaneVector p = load(&block.positions[v]);
        store({hn::Add(from.x, hn::Add(dot(p, a.linear), a.offset)),
               hn::Add(from.y, hn::Add(dot(p, b.linear), b.offset)),
               hn::Add(from.z, hn::Add(dot(p, c.linear), c.offset))},
              &block.positions[v]);
        if (!block.has_normals) continue;

        // The inverse transpose up to a positive factor, as in direction_map.h.
        const LaneVector ca = cross(b.linear, c.linear), cb = cross(c.linear, a.linear),
                         cc = cross(a.linear, b.linear);
        const auto mirrors = hn::Lt(dot(a.linear, ca), hn::Zero(d));
        const Lanes sign = hn::IfThenElse(mirrors, hn::Set(d, -1.0f), hn::Set(d, 1.0f));
        const LaneVector n = load(&block.normals[v]);
        const LaneVector mapped{hn::Mul(dot(n, ca), sign), hn::Mul(dot(n, cb), sign),
                                hn::Mul(dot(n, cc), sign)};
        store(unit(mapped), &block.normals[v]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::anim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::anim {

HWY_EXPORT(skin);

void skin(const AffineRows* rows, const std::uint16_t* joints, const float* weights, std::size_t per_vertex,
          const glm::vec3& origin, SkinBlock& block) {
    HWY_DYNAMIC_DISPATCH(skin)(rows, joints, weights, per_vertex, origin, block);
}

}  // namespace gridreel::anim
#endif
