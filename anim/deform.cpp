#include "anim/frame_geometry.h"
#include "anim/morph.h"
#include "anim/motion.h"
#include "anim/placement.h"
#include "anim/vertex_transform.h"

#include <tbb/parallel_for.h>

#include <cassert>
#include <span>

namespace gridreel::anim {
namespace {

void place_part(const Scene& scene, const Pose& pose, const Part& part, const MapRange& range,
                DeformScratch& scratch, Placement& placement) {
    const Node& node = scene.nodes[part.node];
    const auto maps = std::span{scratch.maps}.subspan(range.first, range.count);
    const auto rows = std::span{scratch.rows}.subspan(range.first, range.count);
    find_maps(scene, pose, node, part.node, is_skinned(node, primitive_of(scene, part)), maps);
    round_maps(maps, placement, rows);
}

/// The run's vertices: the file's shape, morphed, then carried into the world.
void deform_run(const Scene& scene, const Pose& pose, const VertexRun& run, FrameGeometry& geometry) {
    const Part& part = geometry.parts[run.part];
    const Primitive& primitive = primitive_of(scene, part);
    const Placement& placement = geometry.scratch.placements[run.part];
    const MapRange& range = geometry.scratch.map_ranges[run.part];
    const std::span<const AffineRows> rows =
        std::span{geometry.scratch.rows}.subspan(range.first, range.count);

    // Where the run lives in the frame.
    const std::size_t begin = part.first_vertex + run.first;
    VertexSpans vertices{.positions = std::span{geometry.positions}.subspan(begin, run.count)};
    if (part.smooth) vertices.normals = std::span{geometry.normals}.subspan(begin, run.count);
    if (part.has_tangents) vertices.tangents = std::span{geometry.tangents}.subspan(begin, run.count);

    // Morph.
    const std::span<const float> weights = pose.weights[part.node];
    morph_positions(primitive, weights, run.first, placement.centre, vertices.positions);
    if (part.smooth) morph_normals(primitive, weights, run.first, vertices.normals);
    if (part.has_tangents) morph_tangents(primitive, weights, run.first, vertices.tangents);

    // Place.
    if (is_skinned(scene.nodes[part.node], primitive)) {
        transform_skinned(placement, rows, primitive.influences, run.first, vertices);
    } else {
        transform_rigid(placement, rows[0], vertices);
    }
}

}  // namespace

void deform(const Scene& scene, const Pose& pose, FrameGeometry& geometry) {
    assert(pose.world.size() == scene.nodes.size() && pose.weights.size() == scene.nodes.size());
    DeformScratch& scratch = geometry.scratch;
    const auto touched = [&](const Part& part) { return part.moves || !geometry.posed; };

    // Transforms, part by part.
    tbb::parallel_for(std::size_t{0}, geometry.parts.size(), [&](std::size_t p) {
        const Part& part = geometry.parts[p];
        if (touched(part)) {
            place_part(scene, pose, part, scratch.map_ranges[p], scratch, scratch.placements[p]);
        }
    });
    // One after another: neighbours in a vector<bool> share a byte.
    for (std::size_t p = 0; p < geometry.parts.size(); ++p) {
        if (touched(geometry.parts[p])) geometry.mirrored[p] = scratch.placements[p].mirrored;
    }

    // Vertices, in runs short enough that one big part and many small ones both fill the machine.
    const std::vector<VertexRun>& runs = geometry.posed ? scratch.moving_runs : scratch.all_runs;
    tbb::parallel_for(std::size_t{0}, runs.size(),
                      [&](std::size_t i) { deform_run(scene, pose, runs[i], geometry); });
    geometry.posed = true;
}

}  // namespace gridreel::anim
