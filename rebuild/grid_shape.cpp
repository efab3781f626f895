#include "rebuild/grid_shape.h"

#include "rebuild/cell_mapping.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

namespace gridreel::rebuild {
namespace {

/// A box with some thickness on every axis, so that cells have a size.
Bounds3 padded(const Bounds3& box) {
    const glm::vec3 extent = box.extent();
    const float largest = std::max({extent.x, extent.y, extent.z});
    const glm::vec3 size = glm::max(glm::abs(box.min), glm::abs(box.max));
    // At least an ulp or two of the coordinates, or the padding would round away far from the origin.
    const glm::vec3 pad = glm::max(glm::vec3{1e-5f * largest}, glm::max(size * 4e-7f, glm::vec3{1e-30f}));
    return {.min = box.min - pad, .max = box.max + pad};
}

}  // namespace

Bounds3 traceable_bounds(const TriangleView& view, const TriangleList& list) {
    constexpr std::size_t grain = 1 << 13;
    using Range = tbb::blocked_range<std::size_t>;
    if (list.count <= grain) return bounds_of(view, list, 0, list.count);
    // Minimum and maximum do not depend on the order in which parts are joined.
    return tbb::parallel_reduce(
        Range(0, list.count, grain), Bounds3{},
        [&](const Range& range, Bounds3 box) {
            box.extend(bounds_of(view, list, range.begin(), range.end()));
            return box;
        },
        [](Bounds3 a, const Bounds3& b) {
            a.extend(b);
            return a;
        });
}

UniformGrid grid_in(const Bounds3& box, std::size_t triangles, const ResolutionPolicy& policy,
                    double least_slack) {
    UniformGrid grid{.bounds = padded(box), .least_slack = least_slack};
    grid.resolution = choose_resolution(grid.bounds, triangles, policy);
    const CellMapping mapping(grid.bounds, grid.resolution, least_slack);
    grid.cell_size = mapping.cell_size();
    grid.slack = mapping.slack();
    return grid;
}

Bounds3 box_of_cell(const UniformGrid& grid, std::size_t cell) {
    const auto x = static_cast<std::size_t>(grid.resolution.x),
               y = static_cast<std::size_t>(grid.resolution.y);
    const std::size_t row = cell / x;
    const std::size_t layer = row / y;
    const glm::dvec3 index{double(cell % x), double(row % y), double(layer)};
    const glm::dvec3 low = glm::dvec3{grid.bounds.min} + index * grid.cell_size;
    return {.min = glm::vec3{low - grid.slack}, .max = glm::vec3{low + grid.cell_size + grid.slack}};
}

}  // namespace gridreel::rebuild
