#include "anim/clip_bounds.h"

#include "anim/frame_geometry.h"
#include "anim/pose.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// The box of some vertices of one frame. Each slice of vertices has its own box, merged at the end.
Box box_of(const FrameGeometry& geometry, const std::vector<std::uint32_t>& vertices) {
    constexpr std::size_t slice = 16'384;
    std::vector<Box> boxes((vertices.size() + slice - 1) / slice);
    tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t i) {
        const std::size_t end = std::min(vertices.size(), (i + 1) * slice);
        for (std::size_t v = i * slice; v < end; ++v) boxes[i].extend(geometry.positions[vertices[v]]);
    });
    Box whole;
    for (const Box& box : boxes) whole.extend(box);
    return whole;
}

}  // namespace

Box clip_bounds(const Scene& scene, const Clip& clip) {
    FrameGeometry geometry = lay_out(scene, clip);
    const std::vector<std::uint32_t> vertices = used_vertices(geometry);
    const int times = clip.duration_s > 0.0 && geometry.moving_triangles() > 0 ? times_sampled : 1;

    Box whole;
    for (int i = 0; i < times; ++i) {
        const double time_s = times == 1 ? 0.0 : clip.duration_s * i / (times - 1);
        deform(scene, pose(scene, clip, time_s), geometry);
        whole.extend(box_of(geometry, vertices));
    }
    return whole;
}

}  // namespace gridreel::anim
