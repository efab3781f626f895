#pragma once
// The triangles of a mesh as the file lists them (glTF 2.0, section 3.7.2).

#include "accessor.h"
#include "file.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gridreel::evaluator {

using Triangle = std::array<std::uint32_t, 3>;

struct MorphTarget {
    Table positions, normals;  ///< displacements; empty or one per vertex
};

struct Primitive {
    Table positions;  ///< of every vertex, used or not
    Table normals;    ///< empty or one per vertex
    std::vector<Triangle> triangles;
    std::vector<MorphTarget> targets;
    std::vector<Table> joints, weights;  ///< JOINTS_0, JOINTS_1, … and WEIGHTS_0, …; four a vertex each
};

/// Every primitive that has positions and triangles, in file order; points and lines are left out.
[[nodiscard]] std::vector<Primitive> read_primitives(const File& file, std::size_t mesh);

}  // namespace gridreel::evaluator
