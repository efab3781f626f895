#include "traversal/packet_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/packet_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/packet_load-inl.h"
#include "traversal/packet_march-inl.h"

#include <array>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Rays [begin, end) of a batch in its own order, at most a packet of them, that do not all run the same way:
/// calls `use` with a packet for every way, and `dead` for each ray that hits nothing.
template <class Use, class Dead>
void for_each_face(const PacketSource& source, std::size_t begin, std::size_t end, Packet& packet,
                   const Use& use, const Dead& dead) {
    std::array<std::array<std::uint32_t, rays_per_packet>, face_count> faces;
    std::array<std::size_t, face_count> counts{};
    for (std::size_t i = begin; i < end; ++i) {
        const auto ray = static_cast<std::uint32_t>(i);
        const RayFrame frame = source.resumed.frame(source.rays, ray);
        if (frame.hits_nothing()) {
            dead(ray);
        } else {
            faces[frame.axes.face()][counts[frame.axes.face()]++] = ray;
        }
    }
    for (unsigned face = 0; face < face_count; ++face) {
        if (counts[face] == 0) continue;
        load_chosen(source, axes_of_face(face), std::span(faces[face].data(), counts[face]), packet);
        use(packet);
    }
}

/// @param store  writes a marched packet's answers
/// @param dead   writes the answer of a ray that hits nothing
template <Wanted wanted, class Store, class Dead>
TraceReport trace_packets(const GridScene& scene, const PacketSource& source, std::size_t first,
                          std::size_t last, const Store& store, const Dead& dead) {
    TraceReport report;
    Packet packet;
    Candidates candidates;
    const bool traceable = !scene.grid.empty() && rebuild::is_traceable(*source.rays.common_origin);
    const auto trace = [&](Packet& loaded) {
        if (traceable) March<wanted>(scene, loaded, candidates, report).run();
        store(loaded);
    };
    for (std::size_t p = first; p < last; ++p) {
        const PacketSource::Cut cut = source.cut(p);
        report.rays += cut.end - cut.begin;
        if (source.sorted != nullptr) {
            if (cut.begin >= source.sorted->face_begin[face_count]) {
                for (std::size_t i = cut.begin; i < cut.end; ++i) dead(source.sorted->order[i]);
                continue;
            }
            load_sorted<wanted>(source, cut, packet);
            trace(packet);
        } else if (load_uniform(source, cut.begin, cut.end - cut.begin, packet)) {
            trace(packet);
        } else {
            for_each_face(source, cut.begin, cut.end, packet, trace, dead);
        }
    }
    return report;
}

TraceReport closest_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                               std::size_t end, HitBatch& hits) {
    return trace_packets<Wanted::closest>(
        scene, source, begin, end, [&](const Packet& packet) { store_hits(packet, hits); },
        [&](std::uint32_t ray) {
            hits.t[ray] = std::numeric_limits<float>::infinity();
            hits.triangle[ray] = no_triangle;
        });
}

TraceReport any_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                           std::size_t end, OcclusionBatch& occluded) {
    return trace_packets<Wanted::any>(
        scene, source, begin, end, [&](const Packet& packet) { store_occlusion(packet, occluded); },
        [&](std::uint32_t ray) { occluded[ray] = 0; });
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

PacketSource::PacketSource(const RayBatch& batch, const ResumedRays& begun, const SortedRays* sorted_rays)
    : rays(batch), resumed(begun), sorted(sorted_rays) {
    const auto packets_for = [](std::size_t count) {
        return (count + rays_per_packet - 1) / rays_per_packet;
    };
    if (sorted == nullptr) {
        packet_begin_.back() = packets_for(rays.size());
        return;
    }
    for (std::size_t face = 0; face <= face_count; ++face) {
        const std::size_t end = face == face_count ? rays.size() : sorted->face_begin[face + 1];
        packet_begin_[face + 1] = packet_begin_[face] + packets_for(end - sorted->face_begin[face]);
    }
}

PacketSource::Cut PacketSource::cut(std::size_t packet) const {
    if (sorted == nullptr) {
        const std::size_t begin = packet * rays_per_packet;
        return {.begin = begin, .end = std::min(begin + rays_per_packet, rays.size()), .axes = {}};
    }
    unsigned face = 0;
    while (packet >= packet_begin_[face + 1]) ++face;
    const std::size_t begin = sorted->face_begin[face] + (packet - packet_begin_[face]) * rays_per_packet;
    const std::size_t face_end = face == face_count ? rays.size() : sorted->face_begin[face + 1];
    return {.begin = begin, .end = std::min(begin + rays_per_packet, face_end), .axes = axes_of_face(face)};
}

HWY_EXPORT(closest_in_packets);
HWY_EXPORT(any_in_packets);

TraceReport closest_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                               std::size_t end, HitBatch& hits) {
    return HWY_DYNAMIC_DISPATCH(closest_in_packets)(scene, source, begin, end, hits);
}

TraceReport any_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                           std::size_t end, OcclusionBatch& occluded) {
    return HWY_DYNAMIC_DISPATCH(any_in_packets)(scene, source, begin, end, occluded);
}

}  // namespace gridreel::traversal
#endif
