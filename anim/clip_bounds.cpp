#include "anim/clip_bounds.h"

#include "anim/frame_geometry.h"
#include "anim/pose.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gridreel::anim {
namespace {

constexpr int times_sampled = 32;

/// Every vertex that a triangle uses, once, ascending.
std::vector<std::uint32_t> used_vertices(const FrameGeometry& geometry) {
    std::vector<bool> used(geometry.positions.size(), false);
    for (const glm::uvec3& triangle : geometry.triangles) {
        for (int corner = 0; corner < 3; ++corner) used[triangle[corner]] = true;
    }
    std::vector<std::uint32_t> vertices;
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (used[v]) vertices.push_back(static_cast<std::uint32_t>(v));
    }
    return vertices;
}

/// Some of the vertices of one part, and the boxes that they have been in.
struct Slice {
    std::size_t part = 0;
    std::span<const std::uint32_t> vertices;
    Box while_shown{};
    Box always{};
};

/// Parts follow each other in the frame, and so do their vertices.
std::vector<Slice> cut(const FrameGeometry& geometry, std::span<const std::uint32_t> vertices) {
    constexpr std::ptrdiff_t longest = 16'384;
    std::vector<Slice> slices;
    auto begin = vertices.begin();
    for (std::size_t p = 0; p < geometry.parts.size(); ++p) {
        const Part& part = geometry.parts[p];
        const auto end = std::lower_bound(begin, vertices.end(), part.first_vertex + part.vertex_count);
        while (begin != end) {
            const auto last = begin + std::min<std::ptrdiff_t>(longest, end - begin);
            slices.push_back({.part = p, .vertices = {begin, last}});
            begin = last;
        }
    }
    return slices;
}

void extend(const FrameGeometry& geometry, Slice& slice) {
    Box box;
    for (const std::uint32_t vertex : slice.vertices) box.extend(geometry.positions[vertex]);
    slice.always.extend(box);
    if (geometry.is_shown[slice.part]) slice.while_shown.extend(box);
}

}  // namespace

Box clip_bounds(const Scene& scene, const Clip& clip) {
    FrameGeometry geometry = lay_out(scene, clip);
    const std::vector<std::uint32_t> vertices = used_vertices(geometry);
    std::vector<Slice> slices = cut(geometry, vertices);
    const int times = clip.duration_s > 0.0 && geometry.moving_triangles() > 0 ? times_sampled : 1;

    for (int i = 0; i < times; ++i) {
        const double time_s = times == 1 ? 0.0 : clip.duration_s * i / (times - 1);
        deform(scene, pose(scene, clip, time_s), geometry);
        tbb::parallel_for(std::size_t{0}, slices.size(), [&](std::size_t s) { extend(geometry, slices[s]); });
    }

    Box whole;
    for (const Slice& slice : slices)
        whole.extend(slice.while_shown.empty() ? slice.always : slice.while_shown);
    return whole;
}

}  // namespace gridreel::anim
