#include "rebuild/cell_mapping.h"

#include "rebuild/triangle_view.h"

#include <glm/common.hpp>

namespace gridreel::rebuild {

CellMapping::CellMapping(const Bounds3& world, const glm::ivec3& resolution, double least_slack)
    : origin_(world.min),
      last_cell_(resolution - 1),
      resolution_(resolution),
      cell_size_((glm::dvec3{world.max} - glm::dvec3{world.min}) / glm::dvec3{resolution}) {
    cells_per_metre_ = glm::vec3{1.0 / cell_size_};
    // (p - origin) * cells_per_metre is off by at most a few units in the last place of a cell number;
    // a thousandth of a cell more lets a walk through the grid round differently, at no cost in references.
    slack_cells_ =
        glm::max(glm::vec3{1e-3f} + glm::vec3{resolution} * 0x1p-21f, glm::vec3{least_slack / cell_size_});
}

CellRange CellMapping::cells_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const {
    if (!is_traceable(a) || !is_traceable(b) || !is_traceable(c)) return no_cells;
    const glm::vec3 low = (glm::min(a, glm::min(b, c)) - origin_) * cells_per_metre_ - slack_cells_;
    const glm::vec3 high = (glm::max(a, glm::max(b, c)) - origin_) * cells_per_metre_ + slack_cells_;
    const glm::vec3 first = glm::clamp(low, glm::vec3{0.0f}, last_cell_);
    const glm::vec3 last = glm::clamp(high, glm::vec3{0.0f}, last_cell_);
    CellRange range;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        range.first[axis] = static_cast<std::uint16_t>(first[static_cast<int>(axis)]);
        range.last[axis] = static_cast<std::uint16_t>(last[static_cast<int>(axis)]);
    }
    return range;
}

}  // namespace gridreel::rebuild
