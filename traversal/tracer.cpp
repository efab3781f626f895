#include "traversal/tracer.h"

#include "traversal/grid_tracer.h"
#include "traversal/naive_tracer.h"

#include <array>
#include <stdexcept>

namespace gridreel::traversal {
namespace {

constexpr std::array kinds{TracerKind::grid, TracerKind::grid_single, TracerKind::naive};

}  // namespace

TraceReport& TraceReport::operator+=(const TraceReport& other) {
    rays += other.rays;
    cells += other.cells;
    triangle_tests += other.triangle_tests;
    return *this;
}

std::unique_ptr<Tracer> make_tracer(const TracerOptions& options) {
    using Traversal = GridTracer::Traversal;
    switch (options.kind) {
        case TracerKind::grid:
            return std::make_unique<GridTracer>(options.resolution, Traversal::coherent);
        case TracerKind::grid_single:
            return std::make_unique<GridTracer>(options.resolution, Traversal::one_by_one);
        case TracerKind::naive:
            return std::make_unique<NaiveTracer>();
    }
    throw std::invalid_argument("unknown kind of tracer");
}

std::string_view name_of(TracerKind kind) {
    switch (kind) {
        case TracerKind::grid:
            return "grid";
        case TracerKind::grid_single:
            return "grid-single";
        case TracerKind::naive:
            return "naive";
    }
    return "";
}

std::optional<TracerKind> tracer_kind(std::string_view name) {
    for (const TracerKind kind : kinds) {
        if (name_of(kind) == name) return kind;
    }
    return std::nullopt;
}

std::span<const TracerKind> tracer_kinds() {
    return kinds;
}

}  // namespace gridreel::traversal
