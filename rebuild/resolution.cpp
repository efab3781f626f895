#include "rebuild/resolution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace gridreel::rebuild {
namespace {

void check(const ResolutionPolicy& policy) {
    if (!(policy.lambda > 0.0f) || !std::isfinite(policy.lambda)) {
        throw std::invalid_argument("lambda must be finite and greater than 0");
    }
    if (policy.max_cells_per_axis < 1 || policy.max_cells_per_axis > 65'535) {
        throw std::invalid_argument("max_cells_per_axis must be in [1, 65535]");
    }
    if (policy.max_cells < 1) throw std::invalid_argument("max_cells must be at least 1");
}

double product(const glm::ivec3& cells) {
    return double(cells.x) * double(cells.y) * double(cells.z);
}

}  // namespace

glm::ivec3 choose_resolution(const Bounds3& world, std::size_t triangle_count,
                             const ResolutionPolicy& policy) {
    check(policy);
    glm::ivec3 cells{1};
    if (world.empty() || triangle_count == 0) return cells;

    const glm::dvec3 extent = glm::dvec3{world.max} - glm::dvec3{world.min};
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double wanted = std::min(double(policy.lambda) * double(triangle_count), double(policy.max_cells));

    // An axis that would get less than one cell gets one, and the others share out all the cells:
    // the rule in as many dimensions as the box really has. Thinnest axis first.
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] < extent[b]; });
    for (int first = 0; first < 3; ++first) {
        const int dimensions = 3 - first;
        double volume = 1.0;
        for (int i = first; i < 3; ++i) volume *= extent[axes[std::size_t(i)]] / longest;
        const double per_longest = std::pow(wanted / volume, 1.0 / dimensions);
        const int thinnest = axes[std::size_t(first)];
        if (!(volume > 0.0) || extent[thinnest] / longest * per_longest < 1.0) continue;
        for (int i = first; i < 3; ++i) {
            const int axis = axes[std::size_t(i)];
            const double n =
                extent[axis] / longest * per_longest * (1.0 + 1e-9);  // a whole number stays whole
            cells[axis] = static_cast<int>(std::clamp(n, 1.0, double(policy.max_cells_per_axis)));
        }
        break;
    }

    // An axis held at one cell can leave the product above the limit, which is a promise.
    while (product(cells) > double(policy.max_cells)) {
        const int widest = cells.x >= cells.y && cells.x >= cells.z ? 0 : cells.y >= cells.z ? 1 : 2;
        cells[widest] = std::max(1, cells[widest] / 2);
    }
    return cells;
}

}  // namespace gridreel::rebuild
