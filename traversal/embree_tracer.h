#pragma once
// Embree behind the tracer interface: what the grid is measured against.

#include "traversal/embree_scene.h"
#include "traversal/ray_sort.h"
#include "traversal/tracer.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace gridreel::traversal {

/// Rebuilds Embree's hierarchy from the caller's own buffers and asks it 16 rays, or one ray, at a time.
///
/// A fair rival, so: nothing but filling and reading Embree's ray structures comes on top of its own work.
/// Its answers differ from those of the other tracers where rounding decides:
/// - rays within rounding of a triangle's edge, or of the ends of (t_min, t_max), may go either way;
/// - of triangles at the same t any may win, not always the lowest index;
/// - corners beyond 1e12 are traced as far as 1e18.
/// Rays that go on behind a triangle go through a filter, which orders hits by the distance of the
/// triangles' planes in double precision: each triangle is met at most once, and of triangles that Embree
/// cannot tell apart in distance some may be left out.
class EmbreeTracer final : public Tracer {
public:
    explicit EmbreeTracer(const EmbreeOptions& options);

    rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) override;
    TraceReport closest_hits(const RayBatch& rays, HitBatch& hits) override;
    TraceReport any_hits(const RayBatch& rays, OcclusionBatch& occluded) override;

    /// Packets, sorted packets, single rays; just one of them when the options say which.
    [[nodiscard]] std::span<const std::string_view> ways() const override;
    void take_way(std::size_t way) override;

private:
    template <class Packets, class Single>
    TraceReport trace(const RayBatch& rays, const Packets& packets, const Single& single);
    [[nodiscard]] bool in_packets(const RayBatch& rays) const;

    /// What packets are cut from: positions in the batch, or null for its own order.
    [[nodiscard]] const std::uint32_t* order_of(const RayBatch& rays);

    EmbreeOptions options_;
    EmbreeRays way_;
    EmbreeScene scene_;
    rebuild::TriangleView triangles_;
    RaySort ray_sort_;
};

}  // namespace gridreel::traversal
