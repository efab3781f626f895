#include "engine/twin_triangles.h"

#include "traversal/ray_batch.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace gridreel::engine {
namespace {

using Corners = std::array<glm::vec3, 3>;

/// A triangle with a number that does not depend on the order of its corners.
struct Candidate {
    std::uint64_t key = 0;
    std::uint32_t triangle = 0;

    friend bool operator<(const Candidate& a, const Candidate& b) {
        return a.key != b.key ? a.key < b.key : a.triangle < b.triangle;
    }
};

/// Finaliser of SplitMix64 (Steele, Lea & Flood 2014).
std::uint64_t mixed(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
    return v ^ (v >> 31);
}

std::uint64_t key_of(anim::Index node, const Corners& corners) {
    std::uint64_t key = mixed(node + 1u);
    for (const glm::vec3& corner : corners) {
        std::uint64_t place = 0;
        // Adding zero makes -0 and 0 one number.
        for (int axis = 0; axis < 3; ++axis)
            place = mixed(place + std::bit_cast<std::uint32_t>(corner[axis] + 0.0f) + 1u);
        key += place;
    }
    return key;
}

bool opposite(const Corners& a, const Corners& b) {
    for (std::size_t first = 0; first < 3; ++first) {
        if (a[0] == b[first] && a[1] == b[(first + 2) % 3] && a[2] == b[(first + 1) % 3]) return true;
    }
    return false;
}

Corners corners_of(const std::vector<glm::vec3>& positions, const glm::uvec3& triangle,
                   std::size_t first_vertex) {
    return {positions[triangle.x - first_vertex], positions[triangle.y - first_vertex],
            positions[triangle.z - first_vertex]};
}

/// The corners as the file has them.
Corners corners_in_file(const anim::Scene& scene, const anim::FrameGeometry& geometry,
                        std::uint32_t triangle) {
    const anim::Part& part = geometry.parts[geometry.triangle_part[triangle]];
    return corners_of(anim::primitive_of(scene, part).positions, geometry.triangles[triangle],
                      part.first_vertex);
}

}  // namespace

TwinTriangles::TwinTriangles(const anim::Scene& scene, const anim::FrameGeometry& geometry) {
    const auto part_of = [&](std::uint32_t triangle) -> const anim::Part& {
        return geometry.parts[geometry.triangle_part[triangle]];
    };

    // Triangles in the same place have the same key.
    std::vector<Candidate> candidates;
    for (const anim::Part& part : geometry.parts) {
        if (part.material && scene.materials[*part.material].double_sided) continue;
        for (std::size_t i = 0; i < part.triangle_count; ++i) {
            candidates.push_back({.triangle = static_cast<std::uint32_t>(part.first_triangle + i)});
        }
    }
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        const std::uint32_t triangle = candidates[i].triangle;
        candidates[i].key = key_of(part_of(triangle).node, corners_in_file(scene, geometry, triangle));
    });
    tbb::parallel_sort(candidates.begin(), candidates.end());

    // Pair each with the first of its key that faces the other way. Many in one place are particles or cards
    // that the pose will part; they are no two sides of one sheet.
    constexpr std::size_t most_in_one_place = 64;
    for (std::size_t begin = 0; begin < candidates.size();) {
        std::size_t end = begin + 1;
        while (end < candidates.size() && candidates[end].key == candidates[begin].key) ++end;
        for (std::size_t i = begin; end - begin > 1 && end - begin <= most_in_one_place && i < end; ++i) {
            const std::uint32_t triangle = candidates[i].triangle;
            const Corners corners = corners_in_file(scene, geometry, triangle);
            const auto twin = std::find_if(
                candidates.begin() + static_cast<std::ptrdiff_t>(begin),
                candidates.begin() + static_cast<std::ptrdiff_t>(end), [&](const Candidate& other) {
                    return part_of(other.triangle).node == part_of(triangle).node &&
                           opposite(corners, corners_in_file(scene, geometry, other.triangle));
                });
            if (twin == candidates.begin() + static_cast<std::ptrdiff_t>(end)) continue;
            if (twins_.empty()) twins_.assign(geometry.triangles.size(), traversal::no_triangle);
            twins_[triangle] = twin->triangle;
        }
        begin = end;
    }
}

std::uint32_t TwinTriangles::twin_of(const anim::FrameGeometry& geometry, std::uint32_t triangle) const {
    if (twins_.empty() || twins_[triangle] == traversal::no_triangle) return traversal::no_triangle;
    const std::uint32_t twin = twins_[triangle];
    const bool together = opposite(corners_of(geometry.positions, geometry.triangles[triangle], 0),
                                   corners_of(geometry.positions, geometry.triangles[twin], 0));
    return together ? twin : traversal::no_triangle;
}

}  // namespace gridreel::engine
