// Glass marbles pour into a bowl.

#include "tools/gallery/marble_simulation.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"
#include "tools/gallery/turns.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace gridreel::gallery {

namespace {

constexpr std::uint32_t most_marbles = 110;

/// Two glasses that swirl around each other.
struct Glass {
    const char* name;
    glm::dvec3 body, swirl;
};

const std::array<Glass, 6> glasses{{{"garnet", {0.55, 0.03, 0.05}, {0.95, 0.72, 0.55}},
                                    {"cobalt", {0.03, 0.12, 0.55}, {0.80, 0.88, 0.95}},
                                    {"emerald", {0.03, 0.36, 0.15}, {0.85, 0.85, 0.30}},
                                    {"amber", {0.85, 0.36, 0.04}, {0.30, 0.07, 0.02}},
                                    {"plum", {0.28, 0.05, 0.36}, {0.92, 0.50, 0.60}},
                                    {"pearl", {0.82, 0.78, 0.70}, {0.06, 0.42, 0.45}}}};

// --- Still things --------------------------------------------------------------------------------

/// From the foot up the outside, over the rim and down the inside.
Shape bowl_shape(const Bowl& bowl, std::uint32_t steps, std::uint32_t sectors) {
    const double half = bowl.half_thickness_m;
    const auto arc = [&](double radius, double part) {
        constexpr double rim_turn = 0.1900956;  // asin(rim_sine) / (2 pi)
        return glm::dvec2(radius * sin_turns(part * rim_turn),
                          bowl.centre().y - radius * cos_turns(part * rim_turn));
    };
    std::vector<glm::dvec2> profile{{0.46, 0.0}, {0.43, 0.05}};
    for (std::uint32_t i = 0; i <= steps; ++i)
        profile.push_back(arc(bowl.radius_m + half, 0.38 + 0.62 * double(i) / double(steps)));
    profile.push_back(arc(bowl.radius_m, 1.0) +
                      glm::dvec2(0.9 * half * bowl.rim_cosine, 0.9 * half * bowl.rim_sine));
    for (std::uint32_t i = 0; i < 2 * steps; ++i)
        profile.push_back(arc(bowl.radius_m - half, 1.0 - double(i) / double(2 * steps)));
    profile.emplace_back(0.0, bowl.lift_m + half);
    return lathe(profile, sectors);
}

void add_still_life(Document& document, const Bowl& bowl, std::uint32_t detail) {
    const Id cloth =
        append(document.materials, {.name = "table", .base_color = {0.52, 0.40, 0.29}, .roughness = 0.9});
    const Shape table = backdrop({.half_width = 6.0,
                                  .front_z = 3.5,
                                  .wall_z = -4.0,
                                  .height = 3.5,
                                  .bend_m = 1.6,
                                  .bend_steps = detail == 0 ? 0 : 4 + 2 * detail});
    add_mesh_node(document, "table", add_mesh(document, "table", table, cloth));
    const Id clay =
        append(document.materials, {.name = "clay", .base_color = {0.50, 0.66, 0.68}, .roughness = 0.35});
    const Shape shape = bowl_shape(bowl, 1 + 2 * detail, 6 + 22 * detail);
    add_mesh_node(document, "bowl", add_mesh(document, "bowl", shape, clay));
}

// --- Marbles -------------------------------------------------------------------------------------

glm::dvec3 swirl(const Glass& glass, const glm::dvec3& d) {
    const double ribbon = sin_turns(0.55 * d.y + 0.30 * d.x + 0.22 * d.z * d.y) - 0.55 * d.z;
    return glm::mix(glass.body, glass.swirl, glm::smoothstep(0.35, 0.65, ribbon));
}

/// Shows marbles `first` to `last`, their glasses in turn: one mesh per glass, one sphere for all.
void add_marbles(Document& document, std::uint32_t first, std::uint32_t last, std::uint32_t frequency,
                 double radius_m, Id material) {
    if (first == last) return;
    const Shape sphere = geodesic_sphere(frequency, radius_m);
    const Id positions = add_positions(document, sphere.positions);
    const Id normals = add_normals(document, sphere.normals);
    const Id indices = add_indices(document, sphere.triangles, sphere.positions.size());

    std::array<std::optional<Id>, glasses.size()> meshes;
    for (std::uint32_t marble = first; marble < last; ++marble) {
        const Glass& glass = glasses[marble % glasses.size()];
        std::optional<Id>& mesh = meshes[marble % glasses.size()];
        if (!mesh) {
            std::vector<glm::u8vec4> colors;
            for (const glm::vec3& normal : sphere.normals)
                colors.push_back(color_bytes(swirl(glass, glm::dvec3(normal))));
            mesh = append(document.meshes, Mesh{.name = glass.name,
                                                .attributes = {{"POSITION", positions},
                                                               {"NORMAL", normals},
                                                               {"COLOR_0", add_colors(document, colors)}},
                                                .indices = indices,
                                                .material = material});
        }
        add_mesh_node(document, fmt::format("marble {}", marble), *mesh);
    }
}

void add_motion(Document& document, Id first_node, const MarbleRun& run, const Bowl& bowl) {
    const auto keys = simulate(run, bowl);
    std::vector<float> times;
    for (std::size_t key = 0; key < keys.size(); ++key)
        times.push_back(static_cast<float>(double(key) / run.keys_per_second));
    const Id input = add_times(document, times);

    for (std::uint32_t marble = 0; marble < run.marble_count; ++marble) {
        std::vector<glm::dvec3> translations;
        std::vector<glm::dquat> rotations;
        for (const auto& states : keys) {
            translations.push_back(states[marble].position);
            rotations.push_back(states[marble].rotation);
        }
        const Id node = first_node + marble;
        animate_translation(document, node, input, translations);
        animate_rotation(document, node, input, rotations);
    }
}

}  // namespace

Document make_marbles(std::size_t triangles) {
    Document document{.name = "marbles"};
    const Bowl bowl;
    add_still_life(document, bowl,
                   triangles < 3'000    ? 0
                   : triangles < 15'000 ? 1
                   : triangles < 40'000 ? 2
                                        : 3);

    // Fewer marbles before they would be coarser than icosahedra; two neighbouring finenesses meet the rest.
    const double budget = std::max(20.0, double(triangles) - double(triangle_count(document)));
    const MarbleRun run{.marble_count =
                            static_cast<std::uint32_t>(std::min(budget / 20.0, double(most_marbles)))};
    const double count = double(run.marble_count), faces = budget / 20.0;
    const auto frequency = static_cast<std::uint32_t>(std::sqrt(faces / count));
    const double missing = faces - count * double(frequency) * double(frequency);
    const auto finer_count = static_cast<std::uint32_t>(std::floor(missing / (2.0 * frequency + 1.0) + 0.5));

    const Id glass = append(document.materials, {.name = "glass", .roughness = 0.15, .glow = 0.02});
    const Id first_node = static_cast<Id>(document.nodes.size());
    add_marbles(document, 0, finer_count, frequency + 1, run.radius_m, glass);
    add_marbles(document, finer_count, run.marble_count, frequency, run.radius_m, glass);
    add_motion(document, first_node, run, bowl);

    add_camera(document, {0.35, 3.0, 3.75}, {0.0, 0.52, 0.0}, 32.0, 50.0);
    const glm::dvec3 subject(0.0, 0.5, 0.0);
    add_light(document, "key", {-2.4, 4.6, 2.6}, subject, 0.95, {1.0, 0.95, 0.87});
    add_light(document, "fill", {3.6, 3.2, 2.2}, subject, 0.22, {0.78, 0.88, 1.0});
    return document;
}

}  // namespace gridreel::gallery
