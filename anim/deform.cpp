#include "anim/frame_geometry.h"
#include "anim/morph.h"
#include "anim/placement.h"
#include "anim/rigid_kernel.h"
#include "anim/skin_kernel.h"
#include "anim/trs_matrix.h"
#include "anim/vertex_spans.h"

#include <tbb/parallel_for.h>

#include <cassert>
#include <span>

namespace gridreel::anim {
namespace {

/// From the file's space to the world: one map per joint, or the node's own (glTF 2.0, section 3.7.3.3).
void find_maps(const Scene& scene, const Pose& pose, const Part& part, std::span<glm::dmat4> maps) {
    if (!part.skinned) {
        maps[0] = pose.world[part.node];
        if (part.instance) maps[0] *= matrix_of(scene.nodes[part.node].instances[*part.instance]);
        return;
    }
    const Skin& skin = scene.skins[*scene.nodes[part.node].skin];
    assert(maps.size() == skin.joints.size() && maps.size() == skin.inverse_bind.size());
    for (std::size_t joint = 0; joint < maps.size(); ++joint) {
        maps[joint] = pose.world[skin.joints[joint]] * skin.inverse_bind[joint];
    }
}

void place_part(const Scene& scene, const Pose& pose, std::size_t index, FrameGeometry& geometry) {
    DeformScratch& scratch = geometry.scratch;
    const auto [first, count] = scratch.map_ranges[index];
    const auto maps = std::span{scratch.maps}.subspan(first, count);
    const auto rows = std::span{scratch.rows}.subspan(first, count);
    find_maps(scene, pose, geometry.parts[index], maps);
    round_maps(maps, scratch.placements[index], rows);
}

/// The run's vertices: the file's shape, morphed, then carried into the world.
void deform_run(const Scene& scene, const Pose& pose, const VertexRun& run, FrameGeometry& geometry) {
    const Part& part = geometry.parts[run.part];
    const Primitive& primitive = primitive_of(scene, part);
    const Placement& placement = geometry.scratch.placements[run.part];
    const auto [first_map, map_count] = geometry.scratch.map_ranges[run.part];
    const std::span<const AffineRows> rows = std::span{geometry.scratch.rows}.subspan(first_map, map_count);

    // Where the run lives in the frame.
    const std::size_t begin = part.first_vertex + run.first;
    VertexSpans vertices{.positions = std::span{geometry.positions}.subspan(begin, run.count)};
    if (part.smooth) vertices.normals = std::span{geometry.normals}.subspan(begin, run.count);
    if (part.has_tangents) vertices.tangents = std::span{geometry.tangents}.subspan(begin, run.count);

    const ShapeSpans shape = morph(primitive, pose.weights[part.node], run.first, placement.centre, vertices);
    if (part.skinned) {
        place_skinned(placement, rows, primitive.influences, run.first, shape, vertices);
    } else {
        place_rigid(placement, rows[0], shape, vertices);
    }
}

/// Lists the triangles anew when other parts are shown than before.
void show(const Scene& scene, const Pose& pose, FrameGeometry& geometry) {
    std::vector<bool>& is_shown = geometry.scratch.is_shown;
    is_shown.resize(geometry.parts.size());
    for (std::size_t p = 0; p < is_shown.size(); ++p) is_shown[p] = pose.visible[geometry.parts[p].node];
    if (is_shown != geometry.is_shown) list_triangles(scene, is_shown, geometry);
}

}  // namespace

void deform(const Scene& scene, const Pose& pose, FrameGeometry& geometry) {
    assert(pose.world.size() == scene.nodes.size() && pose.weights.size() == scene.nodes.size());
    DeformScratch& scratch = geometry.scratch;
    const auto touched = [&](const Part& part) { return part.moves || !geometry.posed; };

    // Transforms, part by part.
    tbb::parallel_for(std::size_t{0}, geometry.parts.size(), [&](std::size_t p) {
        if (touched(geometry.parts[p])) place_part(scene, pose, p, geometry);
    });
    // One after another: neighbours in a vector<bool> share a byte.
    for (std::size_t p = 0; p < geometry.parts.size(); ++p) {
        if (touched(geometry.parts[p])) geometry.mirrored[p] = scratch.placements[p].mirrored;
    }

    // Vertices, in runs short enough that one big part and many small ones both fill the machine.
    const std::vector<VertexRun>& runs = geometry.posed ? scratch.moving_runs : scratch.all_runs;
    tbb::parallel_for(std::size_t{0}, runs.size(),
                      [&](std::size_t i) { deform_run(scene, pose, runs[i], geometry); });

    show(scene, pose, geometry);
    geometry.posed = true;
}

}  // namespace gridreel::anim
