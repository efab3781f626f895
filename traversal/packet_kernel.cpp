#include "traversal/packet_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/packet_kernel.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "traversal/packet_load-inl.h"
#include "traversal/packet_march-inl.h"
#include "traversal/parallel_load-inl.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

/// Fills the packet with sorted rays, which all run the same way and can all hit something.
template <Bundle bundle, Wanted wanted>
HWY_INLINE void load_cut(const GridScene& scene, const PacketSource& source, const PacketSource::Cut& cut,
                         Packet& packet) {
    if constexpr (bundle == Bundle::parallel) {
        [[maybe_unused]] const bool all_alive =
            load_parallel_chosen(source, scene.grid.top().bounds, source.sorted->order.data() + cut.begin,
                                 cut.end - cut.begin, packet);
        assert(all_alive);  // `ParallelPlaces` sorted the dead out
    } else {
        load_sorted<wanted>(source, cut, packet);
    }
}

/// Fills the packet with rays in the batch's own order, if they all run the same way and can hit something.
/// @return whether they do
template <Bundle bundle>
HWY_INLINE bool load_as_they_come(const GridScene& scene, const PacketSource& source,
                                  const PacketSource::Cut& cut, Packet& packet) {
    const std::size_t count = cut.end - cut.begin;
    if constexpr (bundle == Bundle::parallel) {
        return load_parallel_run(source, scene.grid.top().bounds, cut.begin, count, packet);
    } else {
        return load_uniform(source, cut.begin, count, packet);
    }
}

/// Rays [begin, end) of a batch in its own order, at most a packet of them, that do not all run the same way,
/// or some of which hit nothing: calls `use` with a packet for every way, and `dead` for each ray that hits
/// nothing.
template <Bundle bundle, class Use, class Dead>
void for_each_face(const GridScene& scene, const PacketSource& source, std::size_t begin, std::size_t end,
                   Packet& packet, const Use& use, const Dead& dead) {
    std::array<std::array<std::uint32_t, rays_per_packet>, face_count> faces;
    std::array<std::size_t, face_count> counts{};
    for (std::size_t i = begin; i < end; ++i) {
        const auto ray = static_cast<std::uint32_t>(i);
        const RayFrame frame = source.resumed.frame(source.rays, ray);
        if (frame.hits_nothing() || !rebuild::is_traceable(source.rays.origin_of(ray))) {
            dead(ray);
        } else {
            faces[frame.axes.face()][counts[frame.axes.face()]++] = ray;
        }
    }
    for (unsigned face = 0; face < face_count; ++face) {
        if (counts[face] == 0) continue;
        if constexpr (bundle == Bundle::parallel) {
            // A resumed ray may be alive by the distance it goes on behind, and dead by rounding of its
            // t_min.
            if (!load_parallel_chosen(source, scene.grid.top().bounds, faces[face].data(), counts[face],
                                      packet)) {
                for (std::size_t i = 0; i < counts[face]; ++i) dead(faces[face][i]);
                continue;
            }
        } else {
            load_chosen(source, axes_of_face(face), std::span(faces[face].data(), counts[face]), packet);
        }
        use(packet);
    }
}

/// Whether any ray can hit anything.
HWY_INLINE bool is_traceable(const GridScene& scene, const PacketSource& source) {
    return !scene.grid.empty() &&
           (!source.rays.common_origin || rebuild::is_traceable(*source.rays.common_origin));
}

/// @param store  writes a marched packet's answers
/// @param dead   writes the answer of a ray that hits nothing
template <Bundle bundle, Wanted wanted, class Store, class Dead>
TraceReport trace_packets(const GridScene& scene, const PacketSource& source, std::size_t first,
                          std::size_t last, const Store& store, const Dead& dead) {
    TraceReport report;
    Packet packet;
    Candidates candidates;
    const bool traceable = is_traceable(scene, source);
    const auto trace = [&](Packet& loaded) {
        March<wanted, bundle>(scene, loaded, candidates, report).run();
        store(loaded);
    };
    for (std::size_t p = first; p < last; ++p) {
        const PacketSource::Cut cut = source.cut(p);
        report.rays += cut.end - cut.begin;
        if (source.sorted != nullptr) {
            if (!traceable || cut.begin >= source.sorted->face_begin[face_count]) {
                for (std::size_t i = cut.begin; i < cut.end; ++i) dead(source.sorted->order[i]);
                continue;
            }
            load_cut<bundle, wanted>(scene, source, cut, packet);
            trace(packet);
        } else if (!traceable) {
            for (std::size_t i = cut.begin; i < cut.end; ++i) dead(static_cast<std::uint32_t>(i));
        } else if (load_as_they_come<bundle>(scene, source, cut, packet)) {
            trace(packet);
        } else {
            for_each_face<bundle>(scene, source, cut.begin, cut.end, packet, trace, dead);
        }
    }
    return report;
}

TraceReport closest_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                               std::size_t end, HitBatch& hits) {
    const auto store = [&](const Packet& packet) { store_hits(packet, hits); };
    const auto dead = [&](std::uint32_t ray) {
        hits.t[ray] = std::numeric_limits<float>::infinity();
        hits.triangle[ray] = no_triangle;
    };
    return source.bundle() == Bundle::parallel
               ? trace_packets<Bundle::parallel, Wanted::closest>(scene, source, begin, end, store, dead)
               : trace_packets<Bundle::pencil, Wanted::closest>(scene, source, begin, end, store, dead);
}

TraceReport any_in_packets(const GridScene& scene, const PacketSource& source, std::size_t begin,
                           std::size_t end, OcclusionBatch& occluded) {
    const auto store = [&](const Packet& packet) { store_occlusion(packet, occluded); };
    const auto dead = [&](std::uint32_t ray) { occluded[ray] = 0; };
    return source.bundle() == Bundle::parallel
               ? trace_packets<Bundle::parallel, Wanted::any>(scene, source, begin, end, store, dead)
               : trace_packets<Bundle::pencil, Wanted::any>(scene, source, begin, end, store, dead);
}

/// Packets of neighbours in the batch's own order: of each so many, one is tried before the others.
template <Bundle bundle>
class Attempts {
public:
    Attempts(const GridScene& scene, const PacketSource& source, OcclusionBatch& occluded)
        : scene_(scene), source_(source), occluded_(occluded) {}

    /// Tries some of packets [begin, end), and the others if most of those succeed.
    void run(std::size_t begin, std::size_t end) {
        constexpr std::size_t sampled_of = 8;
        const auto is_sample = [begin](std::size_t p) { return (p - begin) % sampled_of == sampled_of / 2; };
        std::size_t tried = 0, succeeded = 0;
        for (std::size_t p = begin; p < end; ++p) {
            if (!is_sample(p)) continue;
            ++tried;
            succeeded += trace(source_.cut(p)) ? 1 : 0;
        }
        for (std::size_t p = begin; p < end; ++p) {
            if (is_sample(p)) continue;
            if (tried > 0 && 2 * succeeded >= tried) {
                trace(source_.cut(p));
            } else {
                give_up(source_.cut(p));
            }
        }
    }

    [[nodiscard]] const TraceReport& report() const { return report_; }

private:
    /// @return whether all rays are decided
    bool trace(const PacketSource::Cut& cut) {
        // Sorting a ray takes about 70 cycles, and what is left to be sorted is the dearer the thinner it is.
        constexpr std::uint64_t work_per_ray = 20;
        if (!load_as_they_come<bundle>(scene_, source_, cut, packet_)) {
            give_up(cut);
            return false;
        }
        March<Wanted::any, bundle> march(scene_, packet_, candidates_, report_);
        const BlockMask open = march.run(work_per_ray * packet_.ray_count);
        store_run(packet_, open, occluded_.data() + cut.begin);
        return open == 0;
    }

    void give_up(const PacketSource::Cut& cut) {
        std::fill(occluded_.begin() + cut.begin, occluded_.begin() + cut.end, undecided);
    }

    const GridScene& scene_;
    const PacketSource& source_;
    OcclusionBatch& occluded_;
    TraceReport report_;
    Packet packet_;
    Candidates candidates_;
};

TraceReport any_where_cheap(const GridScene& scene, const PacketSource& source, std::size_t begin,
                            std::size_t end, OcclusionBatch& occluded) {
    assert(source.sorted == nullptr);
    if (!is_traceable(scene, source)) {
        for (std::size_t p = begin; p < end; ++p) {
            const PacketSource::Cut cut = source.cut(p);
            std::fill(occluded.begin() + cut.begin, occluded.begin() + cut.end, std::uint8_t{0});
        }
        return {};
    }
    const auto report_of = [&](auto attempts) {
        for (std::size_t p = begin; p < end; p += packets_per_attempt) {
            attempts.run(p, std::min(p + packets_per_attempt, end));
        }
        return attempts.report();
    };
    return source.bundle() == Bundle::parallel
               ? report_of(Attempts<Bundle::parallel>(scene, source, occluded))
               : report_of(Attempts<Bundle::pencil>(scene, source, occluded));
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

PacketSource::PacketSource(const RayBatch& batch, const ResumedRays& begun, const SortedRays* sorted_rays,
                           const PacketOptions& options)
    : rays(batch),
      resumed(begun),
      sorted(sorted_rays),
      packet_size_(options.side ? static_cast<std::size_t>(*options.side * *options.side) : rays_per_packet) {
    const auto packets_for = [this](std::size_t count) { return (count + packet_size_ - 1) / packet_size_; };
    if (sorted == nullptr) {
        packet_begin_.back() = packets_for(rays.size());
        return;
    }
    for (std::size_t face = 0; face <= face_count; ++face) {
        const std::size_t end = face == face_count ? sorted->order.size() : sorted->face_begin[face + 1];
        packet_begin_[face + 1] = packet_begin_[face] + packets_for(end - sorted->face_begin[face]);
    }
}

PacketSource::Cut PacketSource::cut(std::size_t packet) const {
    if (sorted == nullptr) {
        const std::size_t begin = packet * packet_size_;
        return {.begin = begin, .end = std::min(begin + packet_size_, rays.size()), .axes = {}};
    }
    unsigned face = 0;
    while (packet >= packet_begin_[face + 1]) ++face;
    const std::size_t begin = sorted->face_begin[face] + (packet - packet_begin_[face]) * packet_size_;
    const std::size_t face_end = face == face_count ? sorted->order.size() : sorted->face_begin[face + 1];
    return {.begin = begin, .end = std::min(begin + packet_size_, face_end), .axes = axes_of_face(face)};
}

HWY_EXPORT(closest_in_packets);
HWY_EXPORT(any_in_packets);
HWY_EXPORT(any_where_cheap);

TraceReport any_where_cheap(const GridScene& scene, const PacketSource& source, std::size_t begin,
                            std::size_t end, OcclusionBatch& occluded) {
    return HWY_DYNAMIC_DISPATCH(any_where_cheap)(scene, source, begin, end, occluded);
}

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
