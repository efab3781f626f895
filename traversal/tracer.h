#pragma once
// Every acceleration structure behind one interface: rebuild from triangles, trace batches of rays.

#include "rebuild/build_report.h"
#include "rebuild/resolution.h"
#include "rebuild/triangle_view.h"
#include "traversal/ray_batch.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace gridreel::traversal {

/// What a batch cost, in operations. The same for any number of threads.
struct TraceReport {
    std::uint64_t rays = 0;
    std::uint64_t cells = 0;           ///< cells looked into, by packets or single rays
    std::uint64_t triangle_tests = 0;  ///< ray-triangle intersections computed

    TraceReport& operator+=(const TraceReport& other);
};

/// An acceleration structure. Virtual calls happen once per batch, never per ray.
///
/// Work runs in the calling thread's TBB arena. Answers do not depend on the number of threads, and
/// are the same for every kind of tracer (Tracer kinds differ in speed only).
class Tracer {
public:
    Tracer() = default;
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;
    virtual ~Tracer() = default;

    /// Throws the structure away and builds it anew, from world-space triangles to ready to trace.
    /// `triangles` must stay alive and unchanged until the next rebuild.
    virtual rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) = 0;

    /// Fills `hits` (resized) with the closest hit of every ray.
    virtual TraceReport closest_hits(const RayBatch& rays, HitBatch& hits) = 0;

    /// Fills `occluded` (resized) with whether anything blocks each ray.
    virtual TraceReport any_hits(const RayBatch& rays, OcclusionBatch& occluded) = 0;
};

enum class TracerKind {
    grid,         ///< coherent packets through the grid (Wald et al. 2006)
    grid_single,  ///< one ray at a time through the same grid (Amanatides & Woo 1987)
    naive,        ///< every triangle for every ray: the oracle
};

struct TracerOptions {
    TracerKind kind = TracerKind::grid;
    rebuild::ResolutionPolicy resolution;
};

[[nodiscard]] std::unique_ptr<Tracer> make_tracer(const TracerOptions& options);

/// "grid", "grid-single", "naive": the names of `--accel`.
[[nodiscard]] std::string_view name_of(TracerKind kind);
[[nodiscard]] std::optional<TracerKind> tracer_kind(std::string_view name);
[[nodiscard]] std::span<const TracerKind> tracer_kinds();

}  // namespace gridreel::traversal
