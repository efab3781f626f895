#include "anim/rigid_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "anim/rigid_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "anim/lane_vectors-inl.h"
#include "anim/packed_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gridreel::anim {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE LaneRow same_row(const glm::vec4& row) {
    return {.linear = same_in_all(glm::vec3{row}), .offset = hn::Set(Tag(), row.w)};
}

/// A linear map of directions, row by row.
struct LaneDirections {
    LaneVector a, b, c;
};

HWY_INLINE LaneDirections same_map(const glm::mat3& rows) {
    return {same_in_all(rows[0]), same_in_all(rows[1]), same_in_all(rows[2])};
}

/// Mapped and at unit length.
HWY_INLINE LaneDirection turned(const LaneVector& v, const LaneDirections& map) {
    return direction_of({dot(v, map.a), dot(v, map.b), dot(v, map.c)}, hn::Set(Tag(), 1.0f));
}

/// A block's normals, one by one: for the few blocks where a normal loses its direction.
HWY_NOINLINE void turn_normals_singly(const VertexBlock& block, const DirectionMap& map) {
    for (std::size_t i = 0; i < lane_count; ++i) block.to_normals[i] = map_normal(map, block.normals[i]);
}

/// One map in all lanes.
class RigidMap {
public:
    HWY_INLINE RigidMap(const Placement& placement, const AffineRows& map, const glm::vec3& centre)
        : directions_(placement.directions),
          centre_(same_in_all(centre)),
          origin_(same_in_all(placement.origin)),
          a_(same_row(map.row[0])),
          b_(same_row(map.row[1])),
          c_(same_row(map.row[2])) {}

    HWY_INLINE void place_positions(const VertexBlock& block) const {
        const LaneVector position = difference(packed_.load(block.positions), centre_);
        packed_.store(
            {place(position, a_, origin_.x), place(position, b_, origin_.y), place(position, c_, origin_.z)},
            block.to_positions);
    }

    HWY_INLINE void turn_normals(const VertexBlock& block) const {
        const LaneDirection out = turned(packed_.load(block.normals), same_map(directions_.normal_rows));
        if (HWY_LIKELY(hn::AllTrue(Tag(), out.exists))) {
            packed_.store(out.unit, block.to_normals);
        } else {
            turn_normals_singly(block, directions_);
        }
    }

    HWY_INLINE void turn_tangents(const VertexBlock& block) const {
        const Tag d;
        LaneVector tangent;
        Lanes side;
        hn::LoadInterleaved4(d, &block.tangents->x, tangent.x, tangent.y, tangent.z, side);
        const LaneDirection out = turned(tangent, same_map(directions_.tangent_rows));
        hn::StoreInterleaved4(hn::IfThenElse(out.exists, out.unit.x, hn::Set(d, 1.0f)),
                              hn::IfThenElseZero(out.exists, out.unit.y),
                              hn::IfThenElseZero(out.exists, out.unit.z),
                              hn::Mul(side, hn::Set(d, directions_.handedness)), d, &block.to_tangents->x);
    }

    HWY_INLINE void place_block(const VertexBlock& block) const {
        place_positions(block);
        if (block.normals != nullptr) turn_normals(block);
        if (block.tangents != nullptr) turn_tangents(block);
    }

private:
    const DirectionMap& directions_;
    LaneVector centre_, origin_;
    LaneRow a_, b_, c_;
    PackedVectors packed_;
};

void place_rigid(const Placement& placement, const AffineRows& map, const ShapeSpans& from,
                 const VertexSpans& to) {
    const RigidMap rigid(placement, map, from.centre);
    const std::size_t count = to.positions.size(), whole = count / lane_count * lane_count;
    for (std::size_t first = 0; first < whole; first += lane_count)
        rigid.place_block(block_at(first, from, to));
    if (whole == count) return;
    PaddedBlock rest(whole, from, to);
    rigid.place_block(rest.block());
    rest.write_back();
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::anim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::anim {

HWY_EXPORT(place_rigid);

void place_rigid(const Placement& placement, const AffineRows& map, const ShapeSpans& from,
                 const VertexSpans& to) {
    HWY_DYNAMIC_DISPATCH(place_rigid)(placement, map, from, to);
}

}  // namespace gridreel::anim
#endif
