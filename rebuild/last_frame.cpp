#include "rebuild/last_frame.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace gridreel::rebuild {
namespace {

/// @param first_cell  of a grid of the level above
template <class FirstCell>
void unmark(const std::vector<NestedGrid>& nested, GridLevel& above, const FirstCell& first_cell) {
    for (const NestedGrid& grid : nested) {
        if (grid.dropped) continue;
        const std::size_t cell = first_cell(grid.parent) + grid.cell;
        std::copy_n(grid.displaced, 2, above.references.data() + above.cell_begin.data()[cell]);
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
    for (auto& nested : now_.nested) nested.clear();
    if (!known_) return;
    for (std::size_t depth = 1; depth <= deepest_nesting; ++depth) {
        unmark(last_.nested[depth], grid.levels[depth - 1], [&](std::uint32_t parent) {
            return depth == 1 ? last_.top.first_cell : last(depth - 1, parent).grid.first_cell;
        });
    }
}

bool LastFrame::same_top(const UniformGrid& grid) const {
    return known_ && grid.bounds == last_.top.bounds && grid.resolution == last_.top.resolution &&
           grid.least_slack == last_.top.least_slack;
}

void LastFrame::set_top(const UniformGrid& grid) {
    same_top_ = same_top(grid);
    now_.top = grid;
}

std::optional<std::uint32_t> LastFrame::same_as(std::size_t depth, const NestedGrid& next) const {
    if (!same_top_ || !next.still) return std::nullopt;
    NestedGrid wanted = next;
    if (depth > 1) {
        const std::optional<std::uint32_t>& was = now_.nested[depth - 1][next.parent].was;
        if (!was) return std::nullopt;
        wanted.parent = *was;
    }
    const auto before = [](const NestedGrid& a, const NestedGrid& b) {
        return std::tie(a.parent, a.cell) < std::tie(b.parent, b.cell);
    };
    const std::vector<NestedGrid>& last = last_.nested[depth];
    const auto found = std::lower_bound(last.begin(), last.end(), wanted, before);
    if (found == last.end() || before(wanted, *found) || !found->still) return std::nullopt;
    return static_cast<std::uint32_t>(found - last.begin());
}

std::size_t LastFrame::bytes() const {
    std::size_t sum = still_ ? still_->bytes() : 0;
    for (const Shape* shape : {&last_, &now_}) {
        for (const auto& nested : shape->nested) sum += nested.capacity() * sizeof(NestedGrid);
    }
    return sum;
}

}  // namespace gridreel::rebuild
