#pragma once
// Up to 512 rays from one origin, or of one direction, along one axis, in 32 blocks of 16.

#include "traversal/ray_frame.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

inline constexpr std::size_t rays_per_block = 16;
inline constexpr std::size_t blocks_per_packet = 32;
inline constexpr std::size_t rays_per_packet = rays_per_block * blocks_per_packet;

/// A bit for each block of a packet.
using BlockMask = std::uint64_t;

/// What the rays of a packet have in common.
enum class Bundle {
    pencil,    ///< their origin
    parallel,  ///< their direction
    loose,     ///< neither: they only run nearly the same way
};

/// Rays of one frame (`Axes`), block after block; lanes beyond `ray_count` repeat a ray and can hit nothing.
/// Depths as in `RayFrame`.
///
/// In space sheared so that parallel rays run along K, each is a place in the plane across K, as each ray of
/// a pencil is its slopes: `slope_u` and `slope_v` of parallel rays are where they cross the plane through
/// `origin`, in metres from it, and all bounds of slopes are bounds of places.
struct alignas(64) Packet {
    float slope_u[rays_per_packet];
    float slope_v[rays_per_packet];
    float depth_per_t[rays_per_packet];
    float depth_min[rays_per_packet];
    float depth_max[rays_per_packet];
    std::uint32_t after[rays_per_packet];     ///< at depth_min, triangles with a higher index count too
    float depth[rays_per_packet];             ///< nearest hit so far, first depth_max; -1: needs no more hits
    std::uint32_t triangle[rays_per_packet];  ///< of the nearest hit; `no_hit_yet` before
    std::uint32_t ray[rays_per_packet];       ///< position in the batch

    // Of each block: its slopes lie within centre +- half, widened by `margin`.
    float centre_u[blocks_per_packet];
    float half_u[blocks_per_packet];
    float centre_v[blocks_per_packet];
    float half_v[blocks_per_packet];
    float near_depth[blocks_per_packet];  ///< from `origin`: least depth_min, less `depth_error`
    float far_depth[blocks_per_packet];   ///< from `origin`: greatest depth; negative when the block is done

    // Of each block of loose rays, for whom `centre` and `half` are places at `near_plane`: how those grow
    // with depth up to `far_plane`.
    float turn_u[blocks_per_packet];
    float spread_u[blocks_per_packet];
    float turn_v[blocks_per_packet];
    float spread_v[blocks_per_packet];

    // Of each of parallel or loose rays.
    float begin[rays_per_packet];  ///< depth from `origin` at which the ray starts
    float origin_k[rays_per_packet], origin_u[rays_per_packet], origin_v[rays_per_packet];  ///< the ray's own

    glm::vec3 origin;  ///< the rays', or a point that no parallel ray begins before along K
    Axes axes;
    std::uint32_t ray_count;
    float margin;                          ///< `rounding_margin`, or of parallel rays `place_error`, metres
    float common_slope_u, common_slope_v;  ///< of parallel rays
    float near_plane, far_plane;  ///< of loose rays: depths from `origin` that all their hits lie between

    [[nodiscard]] std::size_t block_count() const {
        return (ray_count + rays_per_block - 1) / rays_per_block;
    }
    [[nodiscard]] BlockMask all_blocks() const { return ~BlockMask{0} >> (64 - block_count()); }
};

/// Lower than any index that could tie with it, so that a hit exactly at a ray's limit does not count.
inline constexpr std::uint32_t no_hit_yet = 0;

}  // namespace gridreel::traversal
