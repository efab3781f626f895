// A rippling knot, a metre across, on the centre spot of a stadium a quarter of a kilometre wide.

#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/morph_surface.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/random.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"
#include "tools/gallery/travelling_wave.h"
#include "tools/gallery/turns.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gridreel::gallery {

namespace {

constexpr double duration_s = 4.0;
constexpr double knot_height_m = 1.5;
constexpr std::array<int, 2> cycles{1, 2};

// --- The knot ------------------------------------------------------------------------------------

constexpr double ring_m = 0.44, winding_m = 0.2, tube_m = 0.098;

/// A (2, 3) torus knot's tube: u along it, v around it. Targets ripple it along its normals.
void knot_at(double u, double v, std::span<glm::dvec3> out) {
    // The knot lies on a torus, so the torus' normal is perpendicular to it: a frame without twist.
    const double around = 2.0 * u, winding = 3.0 * u;
    const double ca = cos_turns(around), sa = sin_turns(around), cw = cos_turns(winding),
                 sw = sin_turns(winding);
    const double reach = ring_m + winding_m * cw;
    const glm::dvec3 centre(reach * ca, winding_m * sw, reach * sa);
    const glm::dvec3 normal(cw * ca, sw, cw * sa);
    const glm::dvec3 along(-3.0 * winding_m * sw * ca - 2.0 * reach * sa, 3.0 * winding_m * cw,
                           -3.0 * winding_m * sw * sa + 2.0 * reach * ca);
    const glm::dvec3 side = glm::normalize(glm::cross(normal, along));
    const glm::dvec3 outward = cos_turns(v) * normal + sin_turns(v) * side;

    out[0] = centre + tube_m * outward;
    // Rings that run along the tube, and a slower screw around it.
    const double rings = 24.0 * u, screw = 9.0 * u + 2.0 * v;
    out[1] = outward * (0.022 * sin_turns(screw));
    out[2] = outward * (-0.022 * cos_turns(screw));
    out[3] = outward * (0.018 * sin_turns(rings));
    out[4] = outward * (-0.018 * cos_turns(rings));
}

/// Three turns through orange, rose and violet along the knot, paler on the side away from its torus.
glm::dvec3 knot_color(double u, double v) {
    const double turn = 3.0 * u;
    const glm::dvec3 ember(0.95, 0.24, 0.02), violet(0.22, 0.03, 0.45);
    const glm::dvec3 base = glm::mix(ember, violet, 0.5 - 0.5 * cos_turns(turn));
    return glm::mix(base, glm::dvec3(1.0, 0.80, 0.55), 0.15 * (0.5 + 0.5 * cos_turns(v)));
}

// --- The bowl ------------------------------------------------------------------------------------

constexpr double ellipse = 1.3;  ///< length over width

glm::dvec3 on_ellipse(double radius, double height, double turn) {
    return {ellipse * radius * cos_turns(turn), height, -radius * sin_turns(turn)};
}

void add_flat_quad(Shape& shape, const std::array<glm::dvec3, 4>& corners, const glm::dvec3& color) {
    Shape quad;
    const glm::dvec3 normal = glm::normalize(glm::cross(corners[2] - corners[0], corners[3] - corners[1]));
    for (const glm::dvec3& corner : corners) {
        quad.positions.emplace_back(corner);
        quad.normals.emplace_back(normal);
    }
    quad.triangles = {{0, 1, 2}, {0, 2, 3}};
    paint(quad, color);
    join(shape, quad);
}

/// The stands' section, from the pitch up: radius and height where each ring ends, and who sits there.
enum class Ring { track, wall, seats };
struct RingEnd {
    double radius_m, height_m;
    Ring ring;
};
constexpr double pitch_radius_m = 44.0;
constexpr std::array<RingEnd, 10> rings{{{46, 0, Ring::track},
                                         {46, 2.2, Ring::wall},
                                         {53, 6.2, Ring::seats},
                                         {60, 10.6, Ring::seats},
                                         {67, 15.4, Ring::seats},
                                         {67, 19.0, Ring::wall},
                                         {76, 26.5, Ring::seats},
                                         {85, 34.6, Ring::seats},
                                         {94, 43.3, Ring::seats},
                                         {94, 49.0, Ring::wall}}};

Shape stands(std::uint32_t sectors) {
    const glm::dvec3 night(0.03, 0.07, 0.16), blue(0.05, 0.14, 0.34), teal(0.06, 0.22, 0.26),
        red(0.36, 0.06, 0.06);
    const std::array<glm::dvec3, 8> crowd{night, blue, teal, blue, night, teal, red, blue};
    Random random(3);
    Shape shape;
    double inner = pitch_radius_m, inner_height = 0.0;
    for (const RingEnd& end : rings) {
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const double from = double(s) / double(sectors), to = double(s + 1) / double(sectors);
            const glm::dvec3 color = end.ring == Ring::track  ? glm::dvec3(0.45, 0.13, 0.06)
                                     : end.ring == Ring::wall ? glm::dvec3(s % 2 == 0 ? 0.62 : 0.50)
                                                              : crowd[random.next() % crowd.size()];
            add_flat_quad(
                shape,
                {on_ellipse(inner, inner_height, to), on_ellipse(inner, inner_height, from),
                 on_ellipse(end.radius_m, end.height_m, from), on_ellipse(end.radius_m, end.height_m, to)},
                color);
        }
        inner = end.radius_m;
        inner_height = end.height_m;
    }
    return shape;
}

/// Mown stripes from wall to wall, and the white lines of the centre.
Shape pitch(std::uint32_t stripes) {
    Shape shape;
    const double half = 58.0, depth = 44.0;
    for (std::uint32_t s = 0; s < stripes; ++s) {
        const double from = -half + 2.0 * half * double(s) / double(stripes);
        const double to = -half + 2.0 * half * double(s + 1) / double(stripes);
        const glm::dvec3 grass = s % 2 == 0 ? glm::dvec3(0.10, 0.30, 0.06) : glm::dvec3(0.13, 0.37, 0.08);
        add_flat_quad(shape, {{{from, 0, depth}, {to, 0, depth}, {to, 0, -depth}, {from, 0, -depth}}}, grass);
    }
    return shape;
}

Shape centre_lines(std::uint32_t sectors) {
    const glm::dvec3 white(0.85);
    const double radius = 9.15, half_width = 0.06, lift = 0.01;
    Shape shape;
    add_flat_quad(shape,
                  {{{-half_width, lift, 40},
                    {half_width, lift, 40},
                    {half_width, lift, -40},
                    {-half_width, lift, -40}}},
                  white);
    for (std::uint32_t s = 0; s < sectors; ++s) {
        const auto at = [&](double r, std::uint32_t sector) {
            const double turn = double(sector) / double(sectors);
            return glm::dvec3(r * cos_turns(turn), lift, -r * sin_turns(turn));
        };
        add_flat_quad(shape,
                      {at(radius - half_width, s + 1), at(radius - half_width, s), at(radius + half_width, s),
                       at(radius + half_width, s + 1)},
                      white);
    }
    return shape;
}

Shape plinth(std::uint32_t sectors) {
    const std::array<glm::dvec2, 8> profile{{{0.62, 0.0},
                                             {0.62, 0.12},
                                             {0.62, 0.12},
                                             {0.50, 0.16},
                                             {0.44, 0.58},
                                             {0.44, 0.58},
                                             {0.40, 0.62},
                                             {0.0, 0.62}}};
    return lathe(profile, sectors);
}

/// `detail` 0 to 2; few triangles however many the knot has.
void add_bowl(Document& document, std::uint32_t detail) {
    const Id paint_job = append(document.materials, {.name = "paint", .roughness = 0.9, .glow = 0.03});
    const std::uint32_t sectors = 12u + 12u * detail;
    add_mesh_node(document, "stands", add_mesh(document, "stands", stands(sectors), paint_job));
    add_mesh_node(document, "pitch", add_mesh(document, "pitch", pitch(8 * (detail + 1)), paint_job));
    if (detail == 0) return;
    add_mesh_node(document, "lines", add_mesh(document, "lines", centre_lines(sectors), paint_job));
    const Id stone =
        append(document.materials, {.name = "stone", .base_color = {0.62, 0.58, 0.52}, .roughness = 0.7});
    add_mesh_node(document, "plinth", add_mesh(document, "plinth", plinth(sectors), stone));
}

/// Turns `node` about y, as far as brings the knot onto itself.
void add_turning(Document& document, Id node) {
    std::vector<float> times;
    std::vector<glm::dquat> keys;
    constexpr int steps = 24;
    for (int key = 0; key <= steps; ++key) {
        const double part = double(key) / steps;
        times.push_back(static_cast<float>(part * duration_s));
        keys.emplace_back(cos_turns(part / 6.0), 0.0, sin_turns(part / 6.0), 0.0);
    }
    animate_rotation(document, node, add_times(document, times), keys);
}

}  // namespace

Document make_stadium(std::size_t triangles) {
    Document document{.name = "stadium"};
    add_bowl(document, triangles < 1500 ? 0 : triangles < 5000 ? 1 : 2);

    const std::size_t still = triangle_count(document);
    const MorphSurface knot{
        .at = knot_at, .color = knot_color, .target_count = 2 * cycles.size(), .aspect = 9.0, .wraps = true};
    const Id lacquer = append(document.materials, {.name = "lacquer", .roughness = 0.3, .glow = 0.02});
    const GridSize size = choose_grid(triangles > still ? triangles - still : 18, knot.aspect, 3);
    const Id node = add_mesh_node(document, "knot", add_morph_mesh(document, "knot", knot, size, lacquer));
    // Stood up, its axis towards the camera.
    const double tilt_turns = 0.19;
    document.nodes.push_back(
        {.name = "stand",
         .translation = {0.0, knot_height_m, 0.0},
         .rotation = {cos_turns(0.5 * tilt_turns), sin_turns(0.5 * tilt_turns), 0.0, 0.0},
         .children = {node}});
    add_wave_weights(document, node, cycles, duration_s, 24 * cycles.back());
    add_turning(document, node);

    const glm::dvec3 subject(0.0, knot_height_m, 0.0);
    add_camera(document, {0.55, 1.45, 3.15}, {0.05, 1.45, 0.0}, 39.0, 500.0);
    add_light(document, "floodlight", {-60.0, 75.0, 60.0}, subject, 1.0, {1.0, 0.95, 0.86});
    add_light(document, "fill", {80.0, 40.0, 50.0}, subject, 0.25, {0.78, 0.88, 1.0});
    return document;
}

}  // namespace gridreel::gallery
