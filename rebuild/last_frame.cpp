#include "rebuild/last_frame.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace gridreel::rebuild {
namespace {

/// Puts back the references that marks lie on; where a grid was dropped they are there still.
void unmark(const Buffer<NestedGrid>& nested, GridLevel& above, const UniformGrid* grids_above) {
    for (const NestedGrid& grid : nested) {
        const std::size_t cell = grids_above[grid.parent].first_cell + grid.cell;
        std::copy_n(grid.displaced, 2, above.references.data() + above.cell_begin[cell]);
    }
}

}  // namespace

void LastFrame::begin(const TriangleView& triangles, float lambda, Grid& grid) {
    if (triangles.still && triangles.still->count() != triangles.size()) {
        throw std::invalid_argument("still triangles of an animation with another number of triangles");
    }
    if (still_ != triangles.still) still_box.reset();
    known_ =
        std::exchange(whole_, false) && triangles.still && still_ == triangles.still && lambda_ == lambda;
    same_top_ = false;
    still_ = triangles.still;
    lambda_ = lambda;
    std::swap(last_, now_);
    for (Buffer<NestedGrid>& nested : now_) nested.begin_frame();
    if (still_ == nullptr) return;
    for (std::size_t depth = 0; depth <= deepest_nesting; ++depth) {
        std::swap(last_grids_[depth], grid.levels[depth].grids);
    }
    if (!known_) return;
    for (std::size_t depth = 1; depth <= deepest_nesting; ++depth) {
        unmark(last_[depth], grid.levels[depth - 1], last_grids_[depth - 1].data());
    }
}

bool LastFrame::compare_top(const UniformGrid& grid) {
    same_top_ = false;
    if (known_) {
        const UniformGrid& last = last_grid(0, 0);
        same_top_ = grid.bounds == last.bounds && grid.resolution == last.resolution &&
                    grid.least_slack == last.least_slack;
    }
    return same_top_;
}

std::optional<std::uint32_t> LastFrame::same_as(std::size_t depth, const NestedGrid& next) const {
    if (!same_top_ || !next.still) return std::nullopt;
    NestedGrid wanted = next;
    if (depth > 1) {
        const std::optional<std::uint32_t>& was = now_[depth - 1][next.parent].was;
        if (!was) return std::nullopt;
        wanted.parent = *was;
    }
    const auto before = [](const NestedGrid& a, const NestedGrid& b) {
        return std::tie(a.parent, a.cell) < std::tie(b.parent, b.cell);
    };
    const Buffer<NestedGrid>& last = last_[depth];
    const auto found = std::lower_bound(last.begin(), last.end(), wanted, before);
    if (found == last.end() || before(wanted, *found) || !found->still) return std::nullopt;
    return static_cast<std::uint32_t>(found - last.begin());
}

std::size_t LastFrame::bytes() const {
    std::size_t sum = still_ ? still_->bytes() : 0;
    for (std::size_t depth = 0; depth <= deepest_nesting; ++depth) {
        sum += last_[depth].bytes() + now_[depth].bytes() + last_grids_[depth].bytes();
    }
    return sum;
}

std::size_t LastFrame::used_bytes() const {
    std::size_t sum = still_ ? still_->bytes() : 0;
    for (std::size_t depth = 0; depth <= deepest_nesting; ++depth) {
        sum += last_[depth].used_bytes() + now_[depth].used_bytes() + last_grids_[depth].used_bytes();
    }
    return sum;
}

}  // namespace gridreel::rebuild
