// A finely meshed figure walks through a forest of few, large triangles; the wind is in the trees.

#include "tools/gallery/gait.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/morph_surface.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/random.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"
#include "tools/gallery/travelling_wave.h"
#include "tools/gallery/turns.h"
#include "tools/gallery/walking_figure.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gridreel::gallery {

namespace {

constexpr int walk_cycles = 4;
constexpr double duration_s = walk_cycles * cycle_duration_s;
constexpr double side_m = 80.0;  ///< of the square of ground

// --- Ground --------------------------------------------------------------------------------------

/// Flat along the path (z = 0), hills beside it.
double ground_height(double x, double z) {
    const double off_path = glm::smoothstep(0.0, 20.0, std::abs(z));
    return off_path * (1.6 + 1.3 * sin_turns(0.021 * x + 0.2) * cos_turns(0.027 * z));
}

/// Its one wave makes the moss breathe, by centimetres.
void ground_at(double u, double v, std::span<glm::dvec3> out) {
    const double x = side_m * (u - 0.5), z = -side_m * (v - 0.5);
    out[0] = {x, ground_height(x, z), z};
    const double phase = 0.05 * x + 0.03 * z, lift_m = 0.04 * glm::smoothstep(0.0, 12.0, std::abs(z));
    out[1] = {0.0, lift_m * sin_turns(phase), 0.0};
    out[2] = {0.0, -lift_m * cos_turns(phase), 0.0};
}

glm::dvec3 ground_color(double u, double v) {
    const double from_path = std::abs(side_m * (v - 0.5));
    const double patches = 0.5 + 0.5 * sin_turns(3.1 * u) * sin_turns(2.3 * v + 0.4);
    const glm::dvec3 moss = glm::mix(glm::dvec3(0.10, 0.22, 0.05), glm::dvec3(0.20, 0.28, 0.07), patches);
    return glm::mix(glm::dvec3(0.36, 0.26, 0.15), moss, glm::smoothstep(0.0, 6.0, from_path));
}

// --- Trees ---------------------------------------------------------------------------------------

struct Tree {
    glm::dvec3 root;
    std::size_t kind;
};

/// A fir: a trunk and three skirts, 56 triangles.
Shape fir(double height_m, double width_m, const glm::dvec3& green) {
    constexpr std::uint32_t sectors = 7;
    const std::array<glm::dvec2, 2> trunk{{{0.035 * height_m, -0.8}, {0.02 * height_m, 0.5 * height_m}}};
    Shape tree = lathe(trunk, sectors);
    paint(tree, {0.20, 0.11, 0.06});
    for (int skirt = 0; skirt < 3; ++skirt) {
        const double low = height_m * (0.2 + 0.22 * skirt), high = low + 0.36 * height_m;
        const double reach = 0.5 * width_m * (1.0 - 0.26 * skirt);
        const std::array<glm::dvec2, 4> profile{{{0.0, low}, {reach, low}, {reach, low}, {0.0, high}}};
        Shape cone = lathe(profile, sectors);
        paint(cone, green * (0.8 + 0.2 * skirt));
        join(tree, cone);
    }
    return tree;
}

/// Scattered a few metres apart; not on the path, nor between it and the camera.
std::vector<Tree> plant(std::size_t count, std::size_t kinds) {
    std::vector<Tree> trees;
    Random random(17);
    while (trees.size() < count) {
        const double x = random.between(-34.0, 34.0), z = random.between(-34.0, 20.0);
        if (z > -2.6 && (z < 11.0 || std::abs(x) < 9.0)) continue;
        const bool crowded = std::ranges::any_of(trees, [&](const Tree& other) {
            const glm::dvec2 apart(other.root.x - x, other.root.z - z);
            return glm::dot(apart, apart) < 10.0;
        });
        if (!crowded) trees.push_back({.root = {x, ground_height(x, z), z}, .kind = random.next() % kinds});
    }
    return trees;
}

/// A tree's top goes round a small ellipse, `cycles` times in the clip.
void add_wind(Document& document, Id tree, double phase, int cycles, Id times, int keys) {
    std::vector<glm::dquat> rotations;
    for (int key = 0; key <= keys; ++key) {
        const double turn = phase + double(cycles) * double(key) / double(keys);
        rotations.push_back(
            glm::normalize(glm::dquat(1.0, 0.012 * sin_turns(turn), 0.0, 0.007 * cos_turns(turn))));
    }
    animate_rotation(document, tree, times, rotations);
}

void add_trees(Document& document, std::size_t count) {
    if (count == 0) return;
    const Id needle = append(document.materials, {.name = "fir", .roughness = 0.9, .glow = 0.04});
    const std::array<Id, 3> kinds{add_mesh(document, "tall fir", fir(15.0, 5.4, {0.07, 0.24, 0.09}), needle),
                                  add_mesh(document, "fir", fir(11.5, 4.8, {0.10, 0.30, 0.08}), needle),
                                  add_mesh(document, "young fir", fir(6.5, 3.4, {0.18, 0.38, 0.10}), needle)};

    constexpr int keys = 60;
    std::vector<float> times;
    for (int key = 0; key <= keys; ++key)
        times.push_back(static_cast<float>(duration_s * double(key) / keys));
    const Id input = add_times(document, times);
    Random random(23);
    for (const Tree& tree : plant(count, kinds.size())) {
        const std::string name = fmt::format("tree {}", document.nodes.size());
        const Id node = add_mesh_node(document, name, kinds[tree.kind], tree.root);
        const double phase = random.between(0.0, 1.0);
        add_wind(document, node, phase, tree.kind == 2 ? 2 : 1, input, keys);
    }
}

}  // namespace

Document make_forest(std::size_t triangles) {
    Document document{.name = "forest"};
    const Id earth = append(document.materials, {.name = "earth", .roughness = 0.95, .glow = 0.04});
    const MorphSurface ground{.at = ground_at, .color = ground_color, .target_count = 2};
    // An even number of rows: the path runs along an edge.
    const auto rows = static_cast<std::uint32_t>(2 * std::clamp<std::size_t>(triangles / 600, 1, 8));
    const Id moss =
        add_mesh_node(document, "ground",
                      add_morph_mesh(document, "ground", ground, {.columns = rows, .rows = rows}, earth));
    constexpr std::array<int, 1> breaths{1};
    add_wave_weights(document, moss, breaths, duration_s, 24);
    add_trees(document, std::min<std::size_t>(triangles / 150, 90));

    const std::size_t coarse = triangle_count(document);
    add_figure(document, triangles > coarse ? triangles - coarse : 1);
    const Id hips_node = add_skeleton(document);
    const Id camera = add_camera(document, {2.6, 1.5, 6.2}, {0.3, 1.55, 0.0}, 40.0, 150.0);
    const Id companion = append(document.nodes, {.name = "companion", .children = {hips_node, camera}});
    add_walk(document, hips_node, companion,
             {.cycles = walk_cycles, .start = {-0.5 * walk_cycles * stride_m, 0.0, 0.0}});
    add_light(document, "sun", {-26.0, 40.0, 34.0}, {0.0, 1.0, 0.0}, 1.2, {1.0, 0.93, 0.80});
    return document;
}

}  // namespace gridreel::gallery
