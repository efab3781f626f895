// A curtain hangs from a rod and billows; waves run through it by morph targets.

#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/morph_surface.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"
#include "tools/gallery/travelling_wave.h"
#include "tools/gallery/turns.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gridreel::gallery {

namespace {

constexpr double duration_s = 3.0;
constexpr double width_m = 3.6;
constexpr double drop_m = 1.9;
constexpr double rod_height_m = 2.35;

/// A train of waves: phase in turns at (u, v), and how far it moves the cloth along x, y and z.
struct Wave {
    glm::dvec2 waves_per_side;
    double phase;
    glm::dvec3 amplitude_m;
};

// Those of a row share a frequency, and so a pair of targets.
constexpr std::array<int, 2> cycles{1, 2};
const std::array<std::array<Wave, 2>, 2> waves{{
    {{{.waves_per_side = {1.25, 0.35}, .phase = 0.0, .amplitude_m = {0.0, 0.05, 0.34}},
      {.waves_per_side = {0.6, -0.5}, .phase = 0.3, .amplitude_m = {0.16, 0.0, 0.10}}}},
    {{{.waves_per_side = {2.6, -0.6}, .phase = 0.1, .amplitude_m = {0.03, 0.02, 0.085}},
      {.waves_per_side = {1.7, 1.1}, .phase = 0.7, .amplitude_m = {0.05, 0.0, 0.06}}}},
}};

/// The cloth at (u, v): u from left to right, v from the hem up to the rod.
void cloth_at(double u, double v, std::span<glm::dvec3> out) {
    const double below_rod = 1.0 - v;
    const double freedom = below_rod * (1.5 - 0.5 * below_rod);

    // At rest: folds that open towards the hem.
    const double fold =
        (0.035 + 0.045 * below_rod) * sin_turns(8.0 * u) + 0.03 * below_rod * sin_turns(3.0 * u + 0.2);
    out[0] = {width_m * (u - 0.5), rod_height_m - drop_m * below_rod, fold};

    for (std::size_t frequency = 0; frequency < waves.size(); ++frequency) {
        glm::dvec3 sine(0.0), cosine(0.0);
        for (const Wave& wave : waves[frequency]) {
            const double turn = wave.waves_per_side.x * u + wave.waves_per_side.y * v + wave.phase;
            sine += wave.amplitude_m * (freedom * sin_turns(turn));
            cosine -= wave.amplitude_m * (freedom * cos_turns(turn));
        }
        out[1 + 2 * frequency] = sine;
        out[2 + 2 * frequency] = cosine;
    }
}

/// From plum at the hem to apricot at the rod, with a pale border.
glm::dvec3 cloth_color(double u, double v) {
    const glm::dvec3 hem(0.33, 0.03, 0.12), middle(0.80, 0.13, 0.09), top(0.93, 0.42, 0.12);
    const glm::dvec3 blend = v < 0.5 ? glm::mix(hem, middle, 2.0 * v) : glm::mix(middle, top, 2.0 * v - 1.0);
    const double from_edge = std::min({u * width_m, (1.0 - u) * width_m, v * drop_m});
    return glm::mix(glm::dvec3(0.93, 0.80, 0.55), blend, glm::smoothstep(0.05, 0.09, from_edge));
}

/// What does not move: backdrop, rod and posts, three balls. `detail` 1 is the coarsest.
void add_still_life(Document& document, std::uint32_t detail) {
    const Id wall =
        append(document.materials, {.name = "paper", .base_color = {0.42, 0.52, 0.56}, .roughness = 0.9});
    const Shape paper = backdrop({.half_width = 3.8,
                                  .front_z = 1.9,
                                  .wall_z = -1.3,
                                  .height = 3.3,
                                  .bend_m = 0.7,
                                  .bend_steps = detail < 2 ? 0 : 2 * detail});
    add_mesh_node(document, "backdrop", add_mesh(document, "backdrop", paper, wall));
    if (detail == 0) return;

    const Id brass =
        append(document.materials, {.name = "brass", .base_color = {0.75, 0.48, 0.16}, .roughness = 0.3});
    const std::uint32_t sectors = std::max<std::uint32_t>(4, 3 * detail);
    const double reach = 0.5 * width_m + 0.12;
    const std::array<glm::dvec2, 2> pole{{{0.025, 0.0}, {0.025, 1.0}}};
    const Shape upright = lathe(pole, sectors);
    Shape stand;
    for (const double side : {-reach, reach}) {
        Shape post = upright;
        for (glm::vec3& p : post.positions) p.y *= static_cast<float>(rod_height_m);
        join(stand, post, {side, 0.0, 0.0});
        join(stand, geodesic_sphere(detail, 0.055), {side, rod_height_m + 0.02, 0.0});
    }
    // The rod lies along x.
    Shape rod = upright;
    for (glm::vec3& p : rod.positions) p = {static_cast<float>(2.0 * reach) * p.y, -p.x, p.z};
    for (glm::vec3& n : rod.normals) n = {n.y, -n.x, n.z};
    join(stand, rod, {-reach, rod_height_m, 0.0});
    add_mesh_node(document, "stand", add_mesh(document, "stand", stand, brass));

    struct Ball {
        const char* name;
        glm::dvec3 color;
        double radius_m, x, z;
    };
    for (const Ball& ball : {Ball{"ink", {0.03, 0.10, 0.30}, 0.27, 0.95, 0.95},
                             Ball{"mint", {0.22, 0.62, 0.44}, 0.17, 0.42, 1.25},
                             Ball{"ivory", {0.85, 0.78, 0.62}, 0.21, -1.15, 1.05}}) {
        const Id glaze =
            append(document.materials, {.name = ball.name, .base_color = ball.color, .roughness = 0.25});
        const Id mesh = add_mesh(document, ball.name, geodesic_sphere(2 * detail, ball.radius_m), glaze);
        add_mesh_node(document, ball.name, mesh, {ball.x, ball.radius_m, ball.z});
    }
}

}  // namespace

Document make_sheet(std::size_t triangles) {
    Document document{.name = "sheet"};

    // About a fifth of the triangles stand still.
    const double still_budget = 0.2 * double(triangles);
    const auto detail = static_cast<std::uint32_t>(std::clamp(std::sqrt(still_budget / 280.0), 0.0, 6.0));
    add_still_life(document, detail);

    const std::size_t still = triangle_count(document);
    const MorphSurface cloth{
        .at = cloth_at, .color = cloth_color, .target_count = 2 * cycles.size(), .aspect = width_m / drop_m};
    const Id silk =
        append(document.materials, {.name = "silk", .roughness = 0.45, .glow = 0.02, .double_sided = true});
    const GridSize size = choose_grid(triangles > still ? triangles - still : 2, cloth.aspect, 1);
    const Id node = add_mesh_node(document, "cloth", add_morph_mesh(document, "cloth", cloth, size, silk));
    add_wave_weights(document, node, cycles, duration_s, 24 * cycles.back());

    add_camera(document, {-0.55, 1.5, 5.6}, {0.0, 1.2, 0.0}, 30.5, 50.0);
    const glm::dvec3 subject(0.0, 1.3, 0.0);
    add_light(document, "key", {-2.6, 4.2, 4.2}, subject, 0.95, {1.0, 0.94, 0.85});
    add_light(document, "fill", {4.0, 2.2, 4.5}, subject, 0.22, {0.75, 0.87, 1.0});
    return document;
}

}  // namespace gridreel::gallery
