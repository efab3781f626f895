#include "traversal/reference_boxes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "traversal/reference_boxes.cpp"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "rebuild/read_position-inl.h"

#if HWY_ONCE
#include <tbb/parallel_for.h>
#endif

HWY_BEFORE_NAMESPACE();
namespace gridreel::traversal {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The boxes of the references in one layer of a grid's cells along z.
void bound_layer(const rebuild::GridLevel& level, const rebuild::UniformGrid& grid,
                 const rebuild::TriangleView& triangles, int z, ReferenceBox* boxes) {
    using rebuild::HWY_NAMESPACE::Four;
    const rebuild::HWY_NAMESPACE::FourTag d;
    const hn::RebindToSigned<decltype(d)> di;
    const rebuild::HWY_NAMESPACE::PositionReader positions(triangles.positions);
    const auto four = [&](const glm::vec3& v) HWY_ATTR {
        HWY_ALIGN const float lanes[4] = {v.x, v.y, v.z, 0.0f};
        return hn::Load(d, lanes);
    };
    const Four origin = four(grid.bounds.min);
    const Four cells_per_metre = four(glm::vec3{1.0 / grid.cell_size});
    const Four per_cell = hn::Set(d, CellPlace::per_cell);
    // Places are rounded by one to whole ones.
    const Four margin = four(glm::vec3{1.0 + double(CellPlace::per_cell) * (grid.slack / grid.cell_size)});
    const Four greatest = hn::Set(d, 255.0f);

    std::size_t cell =
        grid.first_cell + std::size_t(z) * std::size_t(grid.resolution.x) * std::size_t(grid.resolution.y);
    for (int y = 0; y < grid.resolution.y; ++y) {
        for (int x = 0; x < grid.resolution.x; ++x, ++cell) {
            const std::uint32_t begin = level.cell_begin[cell], end = level.cell_begin[cell + 1];
            if (begin == end || (level.references[begin] & rebuild::nested_mark) != 0) continue;
            const Four at = four(glm::vec3(x, y, z));
            const auto place = [&](Four p) HWY_ATTR {
                const Four in_cells = hn::Sub(hn::Mul(hn::Sub(p, origin), cells_per_metre), at);
                return hn::MulAdd(in_cells, per_cell, hn::Set(d, CellPlace::cell_begin));
            };
            const auto whole = [&](Four p) HWY_ATTR {
                return hn::ConvertTo(di, hn::Min(hn::Max(p, hn::Zero(d)), greatest));
            };
            for (std::uint32_t i = begin; i < end; ++i) {
                const glm::uvec3& indices = triangles.triangles[level.references[i]];
                const Four a = positions.at(indices.x), b = positions.at(indices.y),
                           c = positions.at(indices.z);
                const auto low = whole(hn::Sub(place(hn::Min(a, hn::Min(b, c))), margin));
                const auto high = whole(hn::Add(place(hn::Max(a, hn::Max(b, c))), margin));
                const auto lacking = hn::Sub(hn::Set(di, 255), high);
                // Lanes beyond z are whatever stands behind a position.
                const hn::Rebind<std::uint8_t, decltype(d)> bytes;
                const auto xyz = hn::FirstN(di, 3);
                auto* const box = reinterpret_cast<std::uint8_t*>(&boxes[i]);
                hn::StoreU(hn::DemoteTo(bytes, hn::IfThenElseZero(xyz, low)), bytes, box);
                hn::StoreU(hn::DemoteTo(bytes, hn::IfThenElseZero(xyz, lacking)), bytes, box + 4);
            }
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace gridreel::traversal
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gridreel::traversal {

HWY_EXPORT(bound_layer);

void ReferenceBoxes::rebuild(const rebuild::Grid& grid, const rebuild::TriangleView& triangles) {
    for (std::size_t depth = 0; depth < levels_.size(); ++depth) {
        const rebuild::GridLevel& level = grid.levels[depth];
        if (level.grids.empty()) continue;
        levels_[depth].resize(level.references.size());
        tbb::parallel_for(std::size_t{0}, level.grids.size(), [&](std::size_t i) {
            const rebuild::UniformGrid& one = level.grids[i];
            if (one.bounds.empty()) return;
            tbb::parallel_for(0, one.resolution.z, [&](int z) {
                HWY_DYNAMIC_DISPATCH(bound_layer)(level, one, triangles, z, levels_[depth].data());
            });
        });
    }
}

std::size_t ReferenceBoxes::bytes() const {
    std::size_t bytes = 0;
    for (const rebuild::Buffer<ReferenceBox>& level : levels_) bytes += level.bytes();
    return bytes;
}

}  // namespace gridreel::traversal
#endif
