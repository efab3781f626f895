// Small triangles everywhere in a cube, each drifting its own way: no surface, and no order to rely on.

#include "tools/gallery/loose_triangles.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/random.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"

#include <array>
#include <cmath>

namespace gridreel::gallery {

namespace {

constexpr double duration_s = 4.0;
constexpr double drift_m = 0.5;  ///< at most, along each axis, within the clip

/// By Newton's method: std::cbrt may round differently from one C library to the next.
double cube_root(double x) {
    double root = x > 1.0 ? x : 1.0;
    for (int i = 0; i < 100; ++i) root -= (root - x / (root * root)) / 3.0;
    return root;
}

glm::dvec3 point_in_cube(Random& random, double half_side) {
    const double x = random.between(-half_side, half_side);
    const double y = random.between(-half_side, half_side);
    return {x, y, random.between(-half_side, half_side)};
}

/// Corners within a box around a point of the cube; the smaller the more there are, so that rays go about
/// as deep into the soup at any count. The one morph target is the way to the end of the drift.
LooseTriangles ladle(std::size_t count) {
    const double reach_m = 1.2 / cube_root(double(count));
    LooseTriangles soup{.targets = {{}}, .weights = {0.0}};
    soup.corners.reserve(3 * count);
    soup.targets[0].reserve(3 * count);
    soup.colors.reserve(3 * count);
    Random random(7);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 middle = point_in_cube(random, 1.0);
        const glm::dvec3 drift = point_in_cube(random, drift_m);
        // Warm ones rise, cold ones sink.
        const double warmth = 0.5 + 0.5 * drift.y / drift_m;
        const glm::u8vec4 color =
            color_bytes(glm::mix(glm::dvec3(0.05, 0.30, 0.62), glm::dvec3(0.90, 0.34, 0.06), warmth));
        for (int corner = 0; corner < 3; ++corner) {
            soup.corners.emplace_back(middle + point_in_cube(random, reach_m));
            soup.targets[0].emplace_back(drift);
            soup.colors.push_back(color);
        }
    }
    return soup;
}

}  // namespace

Document make_soup(std::size_t triangles) {
    Document document{.name = "soup"};
    const Id material =
        append(document.materials, {.name = "leaf", .roughness = 0.7, .glow = 0.06, .double_sided = true});
    const Id node =
        add_mesh_node(document, "soup", add_loose_mesh(document, "soup", ladle(triangles), material));

    const std::array<float, 2> times{0.0f, static_cast<float>(duration_s)}, weights{0.0f, 1.0f};
    document.channels.push_back({.node = node,
                                 .path = Path::weights,
                                 .times = add_times(document, times),
                                 .values = add_scalars(document, weights)});

    add_camera(document, {0.2, 1.5, 4.4}, {0.2, -0.05, 0.0}, 40.0, 50.0);
    add_light(document, "key", {-2.5, 4.5, 3.5}, {0.0, 0.3, 0.5}, 1.1, {1.0, 0.95, 0.88});
    return document;
}

}  // namespace gridreel::gallery
