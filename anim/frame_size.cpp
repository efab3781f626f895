#include "anim/frame_size.h"

#include "anim/error.h"
#include "anim/frame_geometry.h"
#include "anim/motion.h"
#include "anim/visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gridreel::anim {
namespace {

constexpr double mebibyte = 1024.0 * 1024.0;

/// All primitives of one mesh, placed once.
struct MeshSize {
    double vertices = 0.0, triangles = 0.0, runs = 0.0;
    double parts = 0.0, skinnable = 0.0;  ///< primitives, and those among them that have joints
};

MeshSize size_of(const Mesh& mesh) {
    MeshSize size{.parts = double(mesh.primitives.size())};
    for (const Primitive& primitive : mesh.primitives) {
        const auto vertices = double(primitive.positions.size());
        size.vertices += vertices;
        size.triangles += double(primitive.triangles.size());
        size.runs += std::ceil(vertices / double(longest_run));
        if (primitive.influences.per_vertex > 0) size.skinnable += 1.0;
    }
    return size;
}

/// A vertex with every attribute, whether any part has them or not.
constexpr std::size_t vertex_bytes =
    2 * sizeof(glm::vec3) + sizeof(glm::vec4) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4);
constexpr std::size_t triangle_bytes = sizeof(glm::uvec3) + sizeof(std::uint32_t);
constexpr std::size_t part_bytes = sizeof(Part) + sizeof(MapRange) + sizeof(Placement);
constexpr std::size_t map_bytes = sizeof(glm::dmat4) + sizeof(AffineRows);

double bytes_of(const MeshSize& mesh, double joints) {
    const double maps = mesh.skinnable * joints + (mesh.parts - mesh.skinnable);
    return mesh.vertices * double(vertex_bytes) + mesh.triangles * double(triangle_bytes) +
           mesh.runs * 2.0 * sizeof(VertexRun) + mesh.parts * double(part_bytes) + maps * double(map_bytes);
}

}  // namespace

FrameSize measure_frame(const Scene& scene, const Clip& clip) {
    std::vector<MeshSize> meshes;
    for (const Mesh& mesh : scene.meshes) meshes.push_back(size_of(mesh));

    FrameSize frame;
    double largest = 0.0;
    const std::vector<Shown> shown = shown_in(scene, clip);
    for (const Index node : nodes_in_order(scene, clip)) {
        const Node& placed = scene.nodes[node];
        if (!placed.mesh || shown[node] == Shown::never) continue;
        const MeshSize& mesh = meshes[*placed.mesh];
        const double copies = std::max(1.0, double(placed.instances.size()));
        const double joints = placed.skin ? double(scene.skins[*placed.skin].joints.size()) : 1.0;
        const double bytes = copies * bytes_of(mesh, joints);
        frame.vertices += copies * mesh.vertices;
        frame.triangles += copies * mesh.triangles;
        frame.bytes += bytes;
        if (bytes > largest) frame.largest_node = node;
        largest = std::max(largest, bytes);
    }
    return frame;
}

void check_frame_size(const Scene& scene, const Clip& clip) {
    const FrameSize frame = measure_frame(scene, clip);
    const auto refuse = [&](std::string_view what) {
        throw Error(what, fmt::format("{}: /nodes/{}", scene.name, frame.largest_node),
                    "use a simpler mesh here or fewer instances, or split the scene and render its parts");
    };

    // Vertices and triangles are numbered in 32 bits.
    constexpr double most_items = std::numeric_limits<std::uint32_t>::max();
    if (std::max(frame.vertices, frame.triangles) > most_items)
        refuse("the scene has more than 2^32 - 1 vertices or triangles");

    double once = 0.0;
    for (const Mesh& mesh : scene.meshes) once += bytes_of(size_of(mesh), 1.0);
    const double most_bytes = 4096.0 * mebibyte + 4.0 * once;
    if (frame.bytes > most_bytes)
        refuse(
            fmt::format("a frame has {:.0f} vertices and {:.0f} triangles, which take {:.0f} MiB; meshes of "
                        "their size may ask for {:.0f} MiB",
                        frame.vertices, frame.triangles, frame.bytes / mebibyte, most_bytes / mebibyte));
}

}  // namespace gridreel::anim
