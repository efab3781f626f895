#include "traversal/tracer.h"

#include "traversal/grid_tracer.h"
#include "traversal/naive_tracer.h"

#ifdef GRIDREEL_EMBREE
#include "traversal/embree_tracer.h"
#endif

#include <algorithm>
#include <array>
#include <stdexcept>

namespace gridreel::traversal {
namespace {

constexpr std::array all_kinds{TracerKind::grid, TracerKind::grid_single, TracerKind::naive,
                               TracerKind::embree};
#ifdef GRIDREEL_EMBREE
constexpr std::span<const TracerKind> built_in = all_kinds;
#else
constexpr std::span<const TracerKind> built_in = std::span(all_kinds).first(all_kinds.size() - 1);
#endif

}  // namespace

TraceReport& TraceReport::operator+=(const TraceReport& other) {
    rays += other.rays;
    cells += other.cells;
    triangle_tests += other.triangle_tests;
    extra_bytes = std::max(extra_bytes, other.extra_bytes);
    return *this;
}

std::span<const std::string_view> Tracer::ways() const {
    static constexpr std::array<std::string_view, 1> the_only_one{"the only one"};
    return the_only_one;
}

std::unique_ptr<Tracer> make_tracer(const TracerOptions& options) {
    using Traversal = GridTracer::Traversal;
    switch (options.kind) {
        case TracerKind::grid:
            return std::make_unique<GridTracer>(options.resolution, Traversal::coherent, options.packets);
        case TracerKind::grid_single:
            return std::make_unique<GridTracer>(options.resolution, Traversal::one_by_one);
        case TracerKind::naive:
            return std::make_unique<NaiveTracer>();
        case TracerKind::embree:
#ifdef GRIDREEL_EMBREE
            return std::make_unique<EmbreeTracer>(options.embree);
#else
            break;
#endif
    }
    throw std::invalid_argument("this kind of tracer is not built in");
}

std::string_view name_of(TracerKind kind) {
    switch (kind) {
        case TracerKind::grid:
            return "grid";
        case TracerKind::grid_single:
            return "grid-single";
        case TracerKind::naive:
            return "naive";
        case TracerKind::embree:
            return "embree";
    }
    return "";
}

std::string_view name_of(EmbreeQuality quality) {
    switch (quality) {
        case EmbreeQuality::low:
            return "low";
        case EmbreeQuality::medium:
            return "medium";
        case EmbreeQuality::refit:
            return "refit";
    }
    return "";
}

std::optional<TracerKind> tracer_kind(std::string_view name) {
    for (const TracerKind kind : all_kinds) {
        if (name_of(kind) == name) return kind;
    }
    return std::nullopt;
}

std::span<const TracerKind> tracer_kinds() {
    return built_in;
}

bool is_built_in(TracerKind kind) {
    return std::find(built_in.begin(), built_in.end(), kind) != built_in.end();
}

}  // namespace gridreel::traversal
