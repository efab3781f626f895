#include "anim/skin_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "anim/skin_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "anim/lane_vectors-inl.h"
#include "anim/packed_vectors-inl.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::anim {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// --- Blending ----------------------------------------------------------------------------------

/// A row of a map has four floats; a register holds so many rows.
constexpr std::size_t rows_per_register = lane_count / 4;
constexpr std::size_t registers_per_map = (3 + rows_per_register - 1) / rows_per_register;

/// One vertex's own map: row after row.
struct BlendedMap {
    Lanes part[registers_per_map];
};

/// Rows of the maps of `rows_per_register` vertices: row r of all of them in one register.
struct BlendedRows {
    Lanes row[3];
};

/// What the vertices of a run hang on. `Count` is a number of joints, if possible one known to the compiler.
template <class Count>
struct Bonds {
    const AffineRows* maps;
    const std::uint16_t* joints;  ///< of the run's first vertex
    const float* weights;
    Count per_vertex;
};

/// Part of a map.
HWY_INLINE Lanes load_part(const float* from) {
    Lanes part = hn::Load(Tag(), from);
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3 && (HWY_COMPILER_GCC || HWY_COMPILER_CLANG)
    // An instruction takes one operand from memory. Let it be the weight and not the map: loading a weight
    // into all lanes on its own costs as much arithmetic as the multiplication (Zen 4: 7 % of the loop).
    asm("" : "+v"(part.raw));
#endif
    return part;
}

/// The weighted sum of the maps of one vertex's joints, in their order.
template <class Count>
HWY_INLINE BlendedMap blend(const Bonds<Count>& bonds, std::size_t vertex) {
    const Tag d;
    const std::uint16_t* const joints = bonds.joints + vertex * bonds.per_vertex;
    const float* const weights = bonds.weights + vertex * bonds.per_vertex;
    const auto weighted = [&](std::size_t joint, std::size_t part) HWY_ATTR {
        const float* const map = &bonds.maps[joints[joint]].row[0].x;
        return hn::Mul(hn::Set(d, weights[joint]), load_part(map + part * lane_count));
    };
    BlendedMap sum;
    for (std::size_t part = 0; part < registers_per_map; ++part) sum.part[part] = weighted(0, part);
    for (std::size_t joint = 1; joint < bonds.per_vertex; ++joint) {
        for (std::size_t part = 0; part < registers_per_map; ++part)
            sum.part[part] = hn::Add(sum.part[part], weighted(joint, part));
    }
    return sum;
}

/// Which vertices of a run make up a block: these, one after another.
struct Consecutive {
    std::size_t first;
    HWY_INLINE std::size_t operator()(std::size_t i) const { return first + i; }
};

/// Or so, but none behind the last, which stands in for them.
struct ConsecutiveUpTo {
    std::size_t first, last;
    HWY_INLINE std::size_t operator()(std::size_t i) const { return std::min(first + i, last); }
};

/// The maps of every fourth vertex of a block, from `first` on, so that `transposed` finds each in its lane.
template <class Count, class Vertex>
HWY_INLINE BlendedRows blend_every_fourth(const Bonds<Count>& bonds, std::size_t first,
                                          const Vertex& vertex) {
    const Tag d;
    const BlendedMap a = blend(bonds, vertex(first));
    if constexpr (rows_per_register == 1) {
        return {{a.part[0], a.part[1], a.part[2]}};
    } else if constexpr (rows_per_register == 2) {
        const BlendedMap b = blend(bonds, vertex(first + 4));
        return {{hn::ConcatLowerLower(d, b.part[0], a.part[0]), hn::ConcatUpperUpper(d, b.part[0], a.part[0]),
                 hn::ConcatLowerLower(d, b.part[1], a.part[1])}};
    } else {
        const BlendedMap b = blend(bonds, vertex(first + 4)), c = blend(bonds, vertex(first + 8)),
                         e = blend(bonds, vertex(first + 12));
        const Lanes ac01 = hn::ConcatLowerLower(d, c.part[0], a.part[0]),
                    be01 = hn::ConcatLowerLower(d, e.part[0], b.part[0]),
                    ac2 = hn::ConcatUpperUpper(d, c.part[0], a.part[0]),
                    be2 = hn::ConcatUpperUpper(d, e.part[0], b.part[0]);
        return {{hn::OddEvenBlocks(hn::SwapAdjacentBlocks(be01), ac01),
                 hn::OddEvenBlocks(be01, hn::SwapAdjacentBlocks(ac01)),
                 hn::OddEvenBlocks(hn::SwapAdjacentBlocks(be2), ac2)}};
    }
}

/// The maps of a block's vertices as they are blended: the k-th quarter holds vertices k, k + 4, ...
struct BlendedBlock {
    BlendedRows quarter[4];
};

template <class Count, class Vertex>
HWY_INLINE BlendedBlock blend_block(const Bonds<Count>& bonds, const Vertex& vertex) {
    return {{blend_every_fourth(bonds, 0, vertex), blend_every_fourth(bonds, 1, vertex),
             blend_every_fourth(bonds, 2, vertex), blend_every_fourth(bonds, 3, vertex)}};
}

/// Row `r` of all maps of a block, component by component.
HWY_INLINE LaneRow transposed(const BlendedBlock& maps, std::size_t r) {
    const Tag d;
    const hn::RepartitionToWide<hn::RebindToUnsigned<Tag>> pairs;
    const Lanes a = maps.quarter[0].row[r], b = maps.quarter[1].row[r], c = maps.quarter[2].row[r],
                e = maps.quarter[3].row[r];
    const auto ab_xy = hn::BitCast(pairs, hn::InterleaveLower(d, a, b)),
               ab_zw = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b)),
               ce_xy = hn::BitCast(pairs, hn::InterleaveLower(d, c, e)),
               ce_zw = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
    return {.linear = {hn::BitCast(d, hn::InterleaveLower(pairs, ab_xy, ce_xy)),
                       hn::BitCast(d, hn::InterleaveUpper(pairs, ab_xy, ce_xy)),
                       hn::BitCast(d, hn::InterleaveLower(pairs, ab_zw, ce_zw))},
            .offset = hn::BitCast(d, hn::InterleaveUpper(pairs, ab_zw, ce_zw))};
}

// --- Placing -----------------------------------------------------------------------------------

/// The linear part of one vertex's own map: the bits of `blend`.
template <class Count>
glm::mat3 blended_directions(const Bonds<Count>& bonds, std::size_t vertex) {
    const std::size_t begin = vertex * bonds.per_vertex;
    glm::mat3 sum{0.0f};
    for (glm::length_t r = 0; r < 3; ++r) {
        const auto weighted = [&](std::size_t joint) {
            const AffineRows& map = bonds.maps[bonds.joints[begin + joint]];
            return bonds.weights[begin + joint] * glm::vec3{map.row[std::size_t(r)]};
        };
        sum[r] = weighted(0);
        for (std::size_t joint = 1; joint < bonds.per_vertex; ++joint) sum[r] += weighted(joint);
    }
    return sum;
}

/// A block's normals, one by one: for the few blocks where a normal loses its direction.
template <class Count, class Vertex>
HWY_NOINLINE void turn_normals_singly(const VertexBlock& block, const Bonds<Count>& bonds,
                                      const Vertex& vertex) {
    for (std::size_t i = 0; i < lane_count; ++i) {
        const DirectionMap map = direction_map(blended_directions(bonds, vertex(i)));
        block.to_normals[i] = map_normal(map, block.normals[i]);
    }
}

/// Places one block of vertices, and blends the maps of the next meanwhile: blending waits for loads, placing
/// for arithmetic, and the processor does not look far enough ahead to overlap them by itself.
///
/// @param maps    in: this block's; out: the next one's
/// @param vertex  the vertices of this block
/// @param next    those of the next
template <class Count, class Vertex>
HWY_INLINE void place_block(const VertexBlock& block, const LaneVector& centre, const LaneVector& origin,
                            const PackedVectors& packed, BlendedBlock& maps, const Bonds<Count>& bonds,
                            const Vertex& vertex, const Vertex& next) {
    const Tag d;
    const LaneRow a = transposed(maps, 0), b = transposed(maps, 1), c = transposed(maps, 2);

    // Positions.
    const LaneVector position = difference(packed.load(block.positions), centre);
    maps.quarter[0] = blend_every_fourth(bonds, 0, next);
    packed.store({place(position, a, origin.x), place(position, b, origin.y), place(position, c, origin.z)},
                 block.to_positions);
    if (block.normals == nullptr) {
        for (std::size_t k = 1; k < 4; ++k) maps.quarter[k] = blend_every_fourth(bonds, k, next);
        return;
    }

    // Normals: the inverse transpose up to a positive factor, as in direction_map.h.
    const LaneVector ca = cross(b.linear, c.linear), cb = cross(c.linear, a.linear),
                     cc = cross(a.linear, b.linear);
    maps.quarter[1] = blend_every_fourth(bonds, 1, next);
    const LaneMask mirrors = hn::Lt(dot(a.linear, ca), hn::Zero(d));
    const Lanes sign = hn::IfThenElse(mirrors, hn::Set(d, -1.0f), hn::Set(d, 1.0f));
    const LaneVector normal = packed.load(block.normals);
    const LaneVector mapped{dot(normal, ca), dot(normal, cb), dot(normal, cc)};
    maps.quarter[2] = blend_every_fourth(bonds, 2, next);
    const LaneDirection turned = direction_of(mapped, sign);
    maps.quarter[3] = blend_every_fourth(bonds, 3, next);
    if (HWY_LIKELY(hn::AllTrue(d, turned.exists))) {
        packed.store(turned.unit, block.to_normals);
    } else {
        turn_normals_singly(block, bonds, vertex);
    }

    // Tangents.
    if (block.tangents == nullptr) return;
    LaneVector tangent;
    Lanes side;
    hn::LoadInterleaved4(d, &block.tangents->x, tangent.x, tangent.y, tangent.z, side);
    const LaneDirection along = direction_of(
        {dot(tangent, a.linear), dot(tangent, b.linear), dot(tangent, c.linear)}, hn::Set(d, 1.0f));
    hn::StoreInterleaved4(hn::IfThenElse(along.exists, along.unit.x, hn::Set(d, 1.0f)),
                          hn::IfThenElseZero(along.exists, along.unit.y),
                          hn::IfThenElseZero(along.exists, along.unit.z), hn::Mul(side, sign), d,
                          &block.to_tangents->x);
}

template <class Count>
void place_run(const Placement& placement, const Bonds<Count>& bonds, const ShapeSpans& from,
               const VertexSpans& to) {
    const PackedVectors packed;
    const LaneVector centre = same_in_all(from.centre), origin = same_in_all(placement.origin);
    const std::size_t count = to.positions.size(), whole = count / lane_count * lane_count;

    // Whole blocks. Behind the last there is nothing to blend: it is blended again, for nothing.
    if (whole > 0) {
        BlendedBlock maps = blend_block(bonds, Consecutive{0});
        for (std::size_t first = 0; first < whole; first += lane_count) {
            const Consecutive next{std::min(first + lane_count, whole - lane_count)};
            place_block(block_at(first, from, to), centre, origin, packed, maps, bonds, Consecutive{first},
                        next);
        }
    }

    // The rest, in a block that is filled up with the last vertex.
    if (whole == count) return;
    const ConsecutiveUpTo vertices{whole, count - 1};
    BlendedBlock maps = blend_block(bonds, vertices);
    PaddedBlock rest(whole, from, to);
    place_block(rest.block(), centre, origin, packed, maps, bonds, vertices, vertices);
    rest.write_back();
}

void place_skinned(const Placement& placement, std::span<const AffineRows> maps, const Influences& influences,
                   std::size_t first, const ShapeSpans& from, const VertexSpans& to) {
    const std::size_t per_vertex = influences.per_vertex;
    const auto place_with = [&](auto count) HWY_ATTR {
        place_run<decltype(count)>(placement,
                                   {.maps = maps.data(),
                                    .joints = influences.joints.data() + first * per_vertex,
                                    .weights = influences.weights.data() + first * per_vertex,
                                    .per_vertex = count},
                                   from, to);
    };
    if (per_vertex == 4) {
        place_with(std::integral_constant<std::size_t, 4>());
    } else {
        place_with(per_vertex);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::anim
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::anim {

HWY_EXPORT(place_skinned);

void place_skinned(const Placement& placement, std::span<const AffineRows> maps, const Influences& influences,
                   std::size_t first, const ShapeSpans& from, const VertexSpans& to) {
    HWY_DYNAMIC_DISPATCH(place_skinned)(placement, maps, influences, first, from, to);
}

}  // namespace gridreel::anim
#endif
