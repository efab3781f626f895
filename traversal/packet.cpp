#include "traversal/packet.h"

#include <algorithm>
#include <cassert>

namespace gridreel::traversal {
namespace {

/// Centre and half width of the block's slopes, the half width rounded up.
void bound_slopes(const float* slopes, float& centre, float& half) {
    const auto [low, high] = std::minmax_element(slopes, slopes + rays_per_block);
    centre = 0.5f * (*low + *high);
    half = std::max(*high - centre, centre - *low) + rounding_margin;
}

}  // namespace

void load_packet(const glm::vec3& origin, Axes axes, std::span<const FramedRay> rays, Packet& packet) {
    assert(!rays.empty() && rays.size() <= rays_per_packet);
    packet.origin = origin;
    packet.axes = axes;
    packet.ray_count = static_cast<std::uint32_t>(rays.size());

    const std::size_t lanes = packet.block_count() * rays_per_block;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const bool real = lane < rays.size();
        const FramedRay& ray = real ? rays[lane] : rays.back();
        packet.slope_u[lane] = ray.frame.slope_u;
        packet.slope_v[lane] = ray.frame.slope_v;
        packet.depth_min[lane] = ray.frame.depth_min;
        packet.after[lane] = ray.frame.after;
        packet.depth[lane] = real ? ray.frame.depth_max : -1.0f;
        packet.triangle[lane] = no_hit_yet;
        packet.ray[lane] = ray.ray;
    }
    for (std::size_t block = 0; block < blocks_per_packet; ++block) {
        if (block >= packet.block_count()) {
            packet.centre_u[block] = packet.centre_v[block] = packet.half_u[block] = packet.half_v[block] =
                0.0f;
            packet.near_depth[block] = 0.0f;
            packet.far_depth[block] = -1.0f;
            continue;
        }
        const std::size_t first = block * rays_per_block;
        bound_slopes(packet.slope_u + first, packet.centre_u[block], packet.half_u[block]);
        bound_slopes(packet.slope_v + first, packet.centre_v[block], packet.half_v[block]);
        // A hit just behind depth_min may be rounded beyond it from a slice before.
        packet.near_depth[block] =
            *std::min_element(packet.depth_min + first, packet.depth_min + first + rays_per_block) *
            (1.0f - static_cast<float>(depth_error));
        packet.far_depth[block] =
            *std::max_element(packet.depth + first, packet.depth + first + rays_per_block);
    }
}

}  // namespace gridreel::traversal
