#pragma once
// From boxes in the world to ranges of cells.

#include "rebuild/bounds.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// The cells a triangle is listed in: from `first` to `last` on each axis, both included.
/// No cells when first > last on some axis.
struct CellRange {
    std::array<std::uint16_t, 3> first{};
    std::array<std::uint16_t, 3> last{};

    [[nodiscard]] std::uint64_t cell_count() const {
        std::uint64_t count = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (first[axis] > last[axis]) return 0;
            count *= static_cast<std::uint64_t>(last[axis] - first[axis] + 1);
        }
        return count;
    }
    friend bool operator==(const CellRange&, const CellRange&) = default;
};

inline constexpr CellRange no_cells{.first = {1, 1, 1}, .last = {0, 0, 0}};

/// The world box cut into `resolution` equal cells.
class CellMapping {
public:
    /// @param least_slack  metres by which ranges are widened at least
    CellMapping(const Bounds3& world, const glm::ivec3& resolution, double least_slack = 0.0);

    /// Cells that come within `slack()` of the triangle's bounding box; none if a corner is not traceable.
    [[nodiscard]] CellRange cells_of(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const;

    [[nodiscard]] glm::dvec3 cell_size() const { return cell_size_; }

    /// Metres by which ranges are widened: above the rounding error of mapping a point to its cell.
    [[nodiscard]] glm::dvec3 slack() const { return glm::dvec3{slack_cells_} * cell_size_; }

    // What `cells_of` computes with, for kernels that do the same.
    [[nodiscard]] const glm::vec3& origin() const { return origin_; }
    [[nodiscard]] const glm::vec3& cells_per_metre() const { return cells_per_metre_; }
    [[nodiscard]] const glm::vec3& slack_cells() const { return slack_cells_; }
    [[nodiscard]] const glm::vec3& last_cell() const { return last_cell_; }
    [[nodiscard]] const glm::ivec3& resolution() const { return resolution_; }

private:
    glm::vec3 origin_;
    glm::vec3 cells_per_metre_;
    glm::vec3 slack_cells_;
    glm::vec3 last_cell_;
    glm::ivec3 resolution_;
    glm::dvec3 cell_size_;
};

/// Calls `visit(cell)` for every cell of `range`, x fastest.
template <class Visit>
void for_each_cell(const CellRange& range, const glm::ivec3& resolution, const Visit& visit) {
    const auto row = static_cast<std::size_t>(resolution.x);
    const auto layer = row * static_cast<std::size_t>(resolution.y);
    for (std::size_t z = range.first[2]; z <= range.last[2]; ++z) {
        for (std::size_t y = range.first[1]; y <= range.last[1]; ++y) {
            const std::size_t begin = z * layer + y * row;
            for (std::size_t x = range.first[0]; x <= range.last[0]; ++x) visit(begin + x);
        }
    }
}

}  // namespace gridreel::rebuild
