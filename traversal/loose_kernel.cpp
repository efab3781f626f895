#include "traversal/loose_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/loose_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/loose_load-inl.h"
#include "traversal/march_alone-inl.h"
#include "traversal/packet_march-inl.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Whether most neighbours run nearly the same way: asked of a few, since most batches that look otherwise
/// are diffuse, and should not pay for the question.
inline bool look_alike(const RayBatch& rays, const PacketSource::Cut& cut) {
    constexpr std::size_t step = 2 * rays_per_block;
    constexpr float nearly = 0.25f;  // between neighbours on a mirror that this packet could cover
    std::size_t asked = 0, alike = 0;
    for (std::size_t i = cut.begin; i + 1 < cut.end; i += step) {
        const RayFrame a = ray_frame(rays, i), b = ray_frame(rays, i + 1);
        ++asked;
        alike += a.axes == b.axes && std::fabs(a.slope_u - b.slope_u) < nearly &&
                         std::fabs(a.slope_v - b.slope_v) < nearly
                     ? 1
                     : 0;
        if (asked >= 4 && 2 * alike < asked) return false;
    }
    return 4 * alike >= 3 * asked;
}

/// Packets of a batch in its own order, and of each face where they run several ways.
template <Wanted wanted, class Store>
class LoosePackets {
public:
    /// @param store  `store(packet, lane)`: writes a ray's answer
    /// @param left   told which rays are left, and nothing of others
    LoosePackets(const GridScene& scene, const PacketSource& source, const Store& store, OcclusionBatch& left)
        : scene_(scene), source_(source), store_(store), left_(left) {}

    void run(const PacketSource::Cut& cut) {
        // Which resumed rays are dead only their own frames tell.
        const bool resumed = !source_.rays.after_triangle.empty();
        if (!look_alike(source_.rays, cut)) {
            std::fill(left_.begin() + cut.begin, left_.begin() + cut.end, undecided);
        } else if (!resumed && load_loose_run(source_, bounds(), cut.begin, cut.end - cut.begin, packet_)) {
            trace();
        } else {
            run_by_face(cut);
        }
    }

    [[nodiscard]] const TraceReport& report() const { return report_; }

private:
    [[nodiscard]] const rebuild::Bounds3& bounds() const { return scene_.grid.top().bounds; }

    void run_by_face(const PacketSource::Cut& cut) {
        constexpr std::size_t worth_a_packet = 2 * rays_per_block;
        std::array<std::size_t, face_count> counts{};
        for (std::size_t i = cut.begin; i < cut.end; ++i) {
            const auto ray = static_cast<std::uint32_t>(i);
            const RayFrame frame = source_.resumed.frame(source_.rays, ray);
            if (may_hit(scene_.grid, source_.rays.origin_of(ray), frame)) {
                faces_[frame.axes.face()][counts[frame.axes.face()]++] = ray;
            } else {
                left_[ray] = undecided;
            }
        }
        for (std::size_t face = 0; face < face_count; ++face) {
            const std::uint32_t* const rays = faces_[face].data();
            if (counts[face] >= worth_a_packet &&
                load_loose_chosen(source_, bounds(), rays, counts[face], packet_)) {
                trace();
            } else {
                for (std::size_t i = 0; i < counts[face]; ++i) left_[rays[i]] = undecided;
            }
        }
    }

    void trace() {
        // Half of what a ray takes in a stream: what is given up is paid for twice.
        constexpr std::uint64_t work_per_ray = 800;
        March<wanted, Bundle::loose> march(scene_, packet_, candidates_, report_);
        const BlockMask open = march.run(work_per_ray * packet_.ray_count);
        for (std::size_t lane = 0; lane < packet_.ray_count; ++lane) {
            const bool is_open = (open >> lane / rays_per_block & 1) != 0;
            if (is_open) {
                left_[packet_.ray[lane]] = undecided;
            } else {
                store_(packet_, lane);
            }
            report_.rays += is_open ? 0 : 1;
        }
    }

    const GridScene& scene_;
    const PacketSource& source_;
    const Store& store_;
    OcclusionBatch& left_;
    TraceReport report_;
    Packet packet_;
    Candidates candidates_;
    std::array<std::array<std::uint32_t, rays_per_packet>, face_count> faces_;
};

template <Wanted wanted, class Store>
TraceReport trace_loose(const GridScene& scene, const PacketSource& source, std::size_t begin,
                        std::size_t end, const Store& store, OcclusionBatch& left) {
    assert(source.sorted == nullptr && !scene.grid.empty());
    LoosePackets<wanted, Store> packets(scene, source, store, left);
    for (std::size_t p = begin; p < end; ++p) packets.run(source.cut(p));
    return packets.report();
}

TraceReport closest_in_loose_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                                     std::size_t end, HitBatch& hits, OcclusionBatch& left) {
    return trace_loose<Wanted::closest>(
        scene, source, begin, end,
        [&](const Packet& packet, std::size_t lane) {
            const std::uint32_t ray = packet.ray[lane];
            const bool hit = packet.depth[lane] < packet.depth_max[lane];
            hits.t[ray] =
                hit ? packet.depth[lane] / packet.depth_per_t[lane] : std::numeric_limits<float>::infinity();
            hits.triangle[ray] = hit ? packet.triangle[lane] : no_triangle;
            left[ray] = 0;
        },
        left);
}

TraceReport any_in_loose_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                                 std::size_t end, OcclusionBatch& occluded) {
    return trace_loose<Wanted::any>(
        scene, source, begin, end,
        [&](const Packet& packet, std::size_t lane) {
            occluded[packet.ray[lane]] = packet.depth[lane] < 0.0f;
        },
        occluded);
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(closest_in_loose_packets);
HWY_EXPORT(any_in_loose_packets);

TraceReport closest_in_loose_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                                     std::size_t end, HitBatch& hits, OcclusionBatch& left) {
    return HWY_DYNAMIC_DISPATCH(closest_in_loose_packets)(scene, source, begin, end, hits, left);
}

TraceReport any_in_loose_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                                 std::size_t end, OcclusionBatch& occluded) {
    return HWY_DYNAMIC_DISPATCH(any_in_loose_packets)(scene, source, begin, end, occluded);
}

}  // namespace gridreel::traversal
#endif
