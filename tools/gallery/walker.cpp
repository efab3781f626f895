// A figure walks along a path of posts; camera and lights go with it.

#include "tools/gallery/gait.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"
#include "tools/gallery/turns.h"
#include "tools/gallery/walking_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gridreel::gallery {

namespace {

constexpr double slab_height_m = 0.012;  ///< of the path that the figure walks on

// --- Still things --------------------------------------------------------------------------------

/// What stands along the path repeats every stride, so that the end of the cycle looks like its start.
void add_path(Document& document, std::uint32_t detail) {
    const Id paper =
        append(document.materials, {.name = "paper", .base_color = {0.62, 0.53, 0.42}, .roughness = 0.9});
    const Shape floor = backdrop({.half_width = 9.0,
                                  .front_z = 2.6,
                                  .wall_z = -2.6,
                                  .height = 4.2,
                                  .bend_m = 1.1,
                                  .bend_steps = detail == 0 ? 0 : 4 * detail});
    add_mesh_node(document, "backdrop", add_mesh(document, "backdrop", floor, paper));
    if (detail == 0) return;

    const Id slate =
        append(document.materials, {.name = "slate", .base_color = {0.20, 0.26, 0.29}, .roughness = 0.8});
    const Id teal =
        append(document.materials, {.name = "teal", .base_color = {0.05, 0.33, 0.34}, .roughness = 0.5});
    const Id gold =
        append(document.materials, {.name = "gold", .base_color = {0.85, 0.52, 0.12}, .roughness = 0.3});
    const Id slab = add_mesh(document, "slab", box({-0.52, 0.0, -0.45}, {0.52, slab_height_m, 0.45}), slate);
    const std::array<glm::dvec2, 5> profile{
        {{0.17, 0.0}, {0.10, 0.08}, {0.085, 0.62}, {0.13, 0.70}, {0.0, 0.70}}};
    const Id post = add_mesh(document, "post", lathe(profile, 8 * detail), teal);
    const Id ball = add_mesh(document, "ball", geodesic_sphere(2 * detail, 0.15), gold);
    for (int i = -4; i <= 4; ++i) {
        const double x = stride_m * double(i);
        const int number = i + 5;
        add_mesh_node(document, fmt::format("slab {}", number), slab, {x, 0.0, 0.0});
        add_mesh_node(document, fmt::format("post {}", number), post, {x + 0.3, 0.0, -1.15});
        add_mesh_node(document, fmt::format("ball {}", number), ball, {x + 0.3, 0.83, -1.15});
    }
}

// --- The camera ---------------------------------------------------------------------------------

/// The camera sways a little, as if carried.
void add_sway(Document& document, Id camera) {
    const glm::dvec3 middle = document.nodes[camera].translation;
    std::vector<float> times;
    std::vector<glm::dvec3> places;
    constexpr int steps = 10;
    for (int key = 0; key <= steps; ++key) {
        const double part = double(key) / steps;
        times.push_back(static_cast<float>(part * cycle_duration_s));
        places.push_back(middle + glm::dvec3(0.0, 0.012 * cos_turns(2.0 * part), 0.03 * sin_turns(part)));
    }
    animate_translation(document, camera, add_times(document, times), places);
}

}  // namespace

Document make_walker(std::size_t triangles) {
    Document document{.name = "walker"};
    add_path(document, triangles < 2'000 ? 0 : triangles < 8'000 ? 1 : 2);
    const std::size_t still = triangle_count(document);
    add_figure(document, triangles > still ? triangles - still : 1);

    const Id hips_node = add_skeleton(document);
    const Id camera = add_camera(document, {1.9, 1.4, 4.6}, {0.12, 0.93, 0.0}, 24.5, 50.0);
    const glm::dvec3 subject(0.0, 1.1, 0.0);
    const Id key = add_light(document, "key", {3.0, 4.0, 2.8}, subject, 1.0, {1.0, 0.94, 0.85});
    const Id fill = add_light(document, "fill", {-3.0, 2.6, 3.4}, subject, 0.25, {0.75, 0.86, 1.0});
    const Id companion =
        append(document.nodes, {.name = "companion", .children = {hips_node, camera, key, fill}});
    add_walk(document, hips_node, companion, {.start = {0.0, slab_height_m, 0.0}});
    add_sway(document, camera);
    return document;
}

}  // namespace gridreel::gallery
