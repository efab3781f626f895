#pragma once
// Every acceleration structure behind one interface: rebuild from triangles, trace batches of rays.

#include "rebuild/build_report.h"
#include "rebuild/resolution.h"
#include "rebuild/triangle_view.h"
#include "traversal/packet_options.h"
#include "traversal/ray_batch.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace gridreel::traversal {

/// What a batch cost, in operations and memory. The same for any number of threads.
struct TraceReport {
    std::uint64_t rays = 0;
    std::uint64_t cells = 0;           ///< cells looked into, by packets or by rays on their own
    std::uint64_t triangle_tests = 0;  ///< ray-triangle intersections computed
    /// Memory of what was made of the structure for incoherent rays, and is not in
    /// `rebuild::BuildReport::bytes`; of several batches, the most.
    std::uint64_t extra_bytes = 0;

    TraceReport& operator+=(const TraceReport& other);
};

/// An acceleration structure. Virtual calls happen once per batch, never per ray.
///
/// Work runs in the calling thread's TBB arena. Answers do not depend on the number of threads, and
/// are the same for every kind of tracer (Tracer kinds differ in speed only), but for Embree's, which are
/// nearly so (traversal/embree_tracer.h).
class Tracer {
public:
    Tracer() = default;
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;
    virtual ~Tracer() = default;

    /// Throws the structure away and builds it anew, from world-space triangles to ready to trace, but for
    /// what only incoherent rays need: their first batch makes that, at its own
    /// cost. `triangles` must stay alive and unchanged until the next rebuild.
    virtual rebuild::BuildReport rebuild(const rebuild::TriangleView& triangles) = 0;

    /// Cells per triangle of the grids that are rebuilt from now on. Answers do not depend on it, and other
    /// structures than grids do not heed it.
    /// @param lambda  finite, > 0
    virtual void set_lambda(float /*lambda*/) {}

    /// Fills `hits` (resized) with the closest hit of every ray.
    virtual TraceReport closest_hits(const RayBatch& rays, HitBatch& hits) = 0;

    /// Fills `occluded` (resized) with whether anything blocks each ray.
    virtual TraceReport any_hits(const RayBatch& rays, OcclusionBatch& occluded) = 0;

    /// The ways in which rays can be asked of the same structure, by name, where only measuring tells which
    /// is the fastest. For benchmarks.
    [[nodiscard]] virtual std::span<const std::string_view> ways() const;

    /// From now on rays are asked in this one of the ways.
    virtual void take_way(std::size_t /*way*/) {}
};

enum class TracerKind {
    grid,         ///< coherent packets (Wald et al. 2006); incoherent rays 32 at a time
    grid_single,  ///< one ray at a time through the same grid (Amanatides & Woo 1987)
    naive,        ///< every triangle for every ray: the oracle
    embree,       ///< Intel's Embree: the rival
};

/// How Embree makes its hierarchy.
enum class EmbreeQuality {
    low,     ///< from scratch every frame, as fast as it can (Morton order)
    medium,  ///< from scratch every frame, by the surface area heuristic
    refit,   ///< medium on the first frame, then the same tree with new boxes, while the topology stays
};

/// How Embree is given rays.
enum class EmbreeRays {
    automatic,  ///< packets where neighbours or something common are known, else single
    packets,    ///< 16 at a time, as they come
    sorted,     ///< as packets; those with something common and no order are sorted by what differs first
    single,
};

struct EmbreeOptions {
    EmbreeQuality quality = EmbreeQuality::low;
    EmbreeRays rays = EmbreeRays::automatic;
};

/// Who says how many cells per triangle a grid gets.
enum class LambdaRule {
    fixed,    ///< `ResolutionPolicy::lambda`, every frame
    by_cost,  ///< a `LambdaChooser`, frame by frame
};

struct TracerOptions {
    TracerKind kind = TracerKind::grid;
    rebuild::ResolutionPolicy resolution;  ///< of the grids
    LambdaRule lambda = LambdaRule::fixed;
    PacketOptions packets{};  ///< of the coherent grid
    EmbreeOptions embree{};
};

/// @throws std::invalid_argument when the kind is not built in
[[nodiscard]] std::unique_ptr<Tracer> make_tracer(const TracerOptions& options);

/// "grid", "grid-single", "naive", "embree": the names of `--accel`, built in or not.
[[nodiscard]] std::string_view name_of(TracerKind kind);
[[nodiscard]] std::optional<TracerKind> tracer_kind(std::string_view name);

/// Those built in: all but Embree, which is where it was found (GRIDREEL_EMBREE).
[[nodiscard]] std::span<const TracerKind> tracer_kinds();
[[nodiscard]] bool is_built_in(TracerKind kind);

/// "low", "medium", "refit": the names of `--embree-quality`.
[[nodiscard]] std::string_view name_of(EmbreeQuality quality);

}  // namespace gridreel::traversal
