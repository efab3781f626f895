#include "anim/frame_geometry.h"
#include "anim/frame_size.h"
#include "anim/motion.h"
#include "anim/visibility.h"

#include <algorithm>
#include <numeric>

namespace gridreel::anim {
namespace {

Part part_of(const Primitive& primitive) {
    return {.material = primitive.material,
            .vertex_count = primitive.positions.size(),
            .smooth = !primitive.normals.empty(),
            // Tangents without normals are to be ignored (glTF 2.0, section 3.7.2.1).
            .has_tangents = !primitive.tangents.empty() && !primitive.normals.empty(),
            .has_texcoords = {!primitive.texcoords[0].empty(), !primitive.texcoords[1].empty()},
            .has_colors = !primitive.colors.empty()};
}

/// Part after part, with its place in the frame's buffers.
class PartList {
public:
    PartList(const Scene& scene, const Clip& clip)
        : scene_(scene), motion_(find_motion(scene, clip)), shown_(shown_in(scene, clip)) {
        for (const Index node : nodes_in_order(scene, clip)) {
            if (scene.nodes[node].mesh && shown_[node] != Shown::never) add_node(node);
        }
    }

    [[nodiscard]] std::vector<Part>& parts() { return parts_; }

private:
    void add_node(Index node) {
        const std::size_t instances = scene_.nodes[node].instances.size();
        if (instances == 0) add_mesh(node, {});
        for (Index i = 0; i < instances; ++i) add_mesh(node, i);
    }

    void add_mesh(Index node, std::optional<Index> instance) {
        const Index mesh = *scene_.nodes[node].mesh;
        const std::vector<Primitive>& primitives = scene_.meshes[mesh].primitives;
        for (Index i = 0; i < primitives.size(); ++i) {
            Part part = part_of(primitives[i]);
            part.node = node;
            part.mesh = mesh;
            part.primitive = i;
            part.instance = instance;
            part.first_vertex = vertices_;
            part.skinned = is_skinned(scene_.nodes[node], primitives[i]);
            part.moves = moves(scene_, motion_, node, primitives[i]);
            part.blinks = shown_[node] == Shown::sometimes;
            vertices_ += part.vertex_count;
            parts_.push_back(part);
        }
    }

    const Scene& scene_;
    Motion motion_;
    std::vector<Shown> shown_;
    std::vector<Part> parts_;
    std::size_t vertices_ = 0;
};

/// What no pose changes: texture coordinates and colours.
void fill_constants(const Scene& scene, FrameGeometry& geometry) {
    for (const Part& part : geometry.parts) {
        const Primitive& primitive = primitive_of(scene, part);
        const auto offset = static_cast<std::ptrdiff_t>(part.first_vertex);
        for (std::size_t set = 0; set < 2; ++set) {
            std::copy(primitive.texcoords[set].begin(), primitive.texcoords[set].end(),
                      geometry.texcoords[set].begin() + (part.has_texcoords[set] ? offset : 0));
        }
        std::copy(primitive.colors.begin(), primitive.colors.end(),
                  geometry.colors.begin() + (part.has_colors ? offset : 0));
    }
}

DeformScratch lay_out_scratch(const Scene& scene, const std::vector<Part>& parts) {
    DeformScratch scratch;
    std::size_t map_count = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const Part& part = parts[p];
        const std::size_t maps = part.skinned ? scene.skins[*scene.nodes[part.node].skin].joints.size() : 1;
        scratch.map_ranges.push_back({.first = map_count, .count = maps});
        scratch.placements.push_back({.centre = centre_of(primitive_of(scene, part).positions)});
        map_count += maps;

        for (std::size_t first = 0; first < part.vertex_count; first += longest_run) {
            const VertexRun run{.part = static_cast<Index>(p),
                                .first = first,
                                .count = std::min(longest_run, part.vertex_count - first)};
            scratch.all_runs.push_back(run);
            if (part.moves) scratch.moving_runs.push_back(run);
        }
    }
    scratch.maps.resize(map_count);
    scratch.rows.resize(map_count);
    return scratch;
}

}  // namespace

const Primitive& primitive_of(const Scene& scene, const Part& part) {
    return scene.meshes[part.mesh].primitives[part.primitive];
}

void list_triangles(const Scene& scene, const std::vector<bool>& is_shown, FrameGeometry& geometry) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < geometry.parts.size(); ++p) {
        Part& part = geometry.parts[p];
        part.first_triangle = count;
        part.triangle_count = is_shown[p] ? primitive_of(scene, part).triangles.size() : 0;
        count += part.triangle_count;
    }
    geometry.triangles.resize(count);
    geometry.triangle_part.resize(count);

    for (std::size_t p = 0; p < geometry.parts.size(); ++p) {
        const Part& part = geometry.parts[p];
        const Primitive& primitive = primitive_of(scene, part);
        const auto first = static_cast<std::uint32_t>(part.first_vertex);
        for (std::size_t i = 0; i < part.triangle_count; ++i) {
            geometry.triangles[part.first_triangle + i] = primitive.triangles[i] + first;
            geometry.triangle_part[part.first_triangle + i] = static_cast<std::uint32_t>(p);
        }
    }
    geometry.is_shown = is_shown;
}

FrameGeometry lay_out(const Scene& scene, const Clip& clip) {
    check_frame_size(scene, clip);
    FrameGeometry geometry;
    geometry.parts = std::move(PartList(scene, clip).parts());
    geometry.mirrored.resize(geometry.parts.size());

    const auto any = [&](auto&& has) {
        return std::any_of(geometry.parts.begin(), geometry.parts.end(), has);
    };
    std::size_t vertices = 0;
    for (const Part& part : geometry.parts) vertices += part.vertex_count;
    geometry.positions.resize(vertices, glm::vec3{0.0f});
    geometry.normals.resize(vertices, glm::vec3{0.0f});
    if (any([](const Part& part) { return part.has_tangents; })) {
        geometry.tangents.resize(vertices, glm::vec4{0.0f});
    }
    for (std::size_t set = 0; set < 2; ++set) {
        if (any([set](const Part& part) { return part.has_texcoords[set]; })) {
            geometry.texcoords[set].resize(vertices, glm::vec2{0.0f});
        }
    }
    if (any([](const Part& part) { return part.has_colors; })) {
        geometry.colors.resize(vertices, glm::vec4{1.0f});
    }
    fill_constants(scene, geometry);
    list_triangles(scene, std::vector<bool>(geometry.parts.size(), true), geometry);
    geometry.scratch = lay_out_scratch(scene, geometry.parts);
    return geometry;
}

std::size_t FrameGeometry::moving_triangles() const {
    return std::accumulate(parts.begin(), parts.end(), std::size_t{0}, [](std::size_t sum, const Part& part) {
        return sum + (part.moves ? part.triangle_count : 0);
    });
}

}  // namespace gridreel::anim
