// A hollow ball breaks into pieces that fly apart, spinning: dense, and in a box that grows every frame.

#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/random.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"
#include "tools/gallery/surface_nets.h"
#include "tools/gallery/turns.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gridreel::gallery {

namespace {

constexpr double duration_s = 4.0;
constexpr int key_count = 32;  ///< intervals of the clip
constexpr double radius_m = 1.0, half_thickness_m = 0.07;

/// Negative between the two skins of a dented ball. Its dents make it up to a third steeper than a
/// distance, hence the factor.
double shell(const glm::dvec3& p) {
    const double dents = sin_turns(0.8 * p.x + 0.1) * sin_turns(0.9 * p.y) * sin_turns(0.7 * p.z + 0.3);
    return 0.75 * (std::abs(glm::length(p) - radius_m - 0.06 * dents) - half_thickness_m);
}

/// Uniform on the sphere: a point of the ball, by rejection, moved out to it.
glm::dvec3 direction(Random& random) {
    for (;;) {
        const double x = random.between(-1.0, 1.0), y = random.between(-1.0, 1.0);
        const glm::dvec3 p(x, y, random.between(-1.0, 1.0));
        const double distance_2 = glm::dot(p, p);
        if (distance_2 <= 1.0 && distance_2 > 1e-4) return p / std::sqrt(distance_2);
    }
}

/// Painted stone outside, embers inside.
glm::dvec3 shell_color(const glm::dvec3& p) {
    if (glm::length(p) < radius_m - 0.4 * half_thickness_m) return {0.95, 0.30, 0.04};
    const double band = 0.5 + 0.5 * sin_turns(2.0 * p.y + 0.15 * sin_turns(1.5 * p.x));
    return glm::mix(glm::dvec3(0.08, 0.26, 0.36), glm::dvec3(0.62, 0.66, 0.60),
                    glm::smoothstep(0.35, 0.65, band));
}

/// For each triangle the piece whose direction is nearest.
std::vector<std::uint32_t> break_up(const Shape& shape, const std::vector<glm::dvec3>& directions) {
    std::vector<std::uint32_t> piece_of(shape.triangles.size());
    tbb::parallel_for(std::size_t{0}, piece_of.size(), [&](std::size_t i) {
        const glm::uvec3& t = shape.triangles[i];
        const glm::dvec3 sum = glm::dvec3(shape.positions[t.x]) + glm::dvec3(shape.positions[t.y]) +
                               glm::dvec3(shape.positions[t.z]);
        double best = -std::numeric_limits<double>::infinity();
        for (std::uint32_t piece = 0; piece < directions.size(); ++piece) {
            const double along = glm::dot(sum, directions[piece]);
            if (along > best) {
                best = along;
                piece_of[i] = piece;
            }
        }
    });
    return piece_of;
}

/// The pieces, with corners relative to their own middle.
struct Piece {
    Shape shape{};
    glm::dvec3 middle{0.0};
};

std::vector<Piece> cut(const Shape& whole, const std::vector<std::uint32_t>& piece_of, std::size_t count) {
    std::vector<Piece> pieces(count);
    std::vector<std::vector<glm::uvec3>> triangles(count);
    for (std::size_t i = 0; i < piece_of.size(); ++i) triangles[piece_of[i]].push_back(whole.triangles[i]);

    constexpr auto none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(whole.positions.size(), none);
    for (std::size_t p = 0; p < count; ++p) {
        Piece& piece = pieces[p];
        std::vector<std::uint32_t> used;
        for (glm::uvec3 t : triangles[p]) {
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t old = t[corner];
                if (number[old] == none) {
                    number[old] = static_cast<std::uint32_t>(used.size());
                    used.push_back(old);
                }
                t[corner] = number[old];
            }
            piece.shape.triangles.push_back(t);
        }
        for (const std::uint32_t old : used) piece.middle += glm::dvec3(whole.positions[old]);
        if (!used.empty()) piece.middle /= double(used.size());
        for (const std::uint32_t old : used) {
            const glm::dvec3 place(whole.positions[old]);
            piece.shape.positions.emplace_back(place - piece.middle);
            piece.shape.normals.push_back(whole.normals[old]);
            piece.shape.colors.push_back(color_bytes(shell_color(place)));
            number[old] = none;
        }
    }
    return pieces;
}

/// Fast at first, slowed by the air, sinking; spinning all the time.
void add_flight(Document& document, Id node, Random& random, Id times) {
    const glm::dvec3 start = document.nodes[node].translation;
    const double outward = random.between(0.7, 1.6);
    const glm::dvec3 speed = outward * glm::normalize(start) + 0.25 * direction(random);
    const glm::dvec3 axis = direction(random);
    const double turns = random.between(0.3, 1.2);

    std::vector<glm::dvec3> places;
    std::vector<glm::dquat> rotations;
    for (int key = 0; key <= key_count; ++key) {
        const double part = double(key) / key_count, t = part * duration_s;
        places.push_back(start + speed * (t / (1.0 + 0.4 * t)) - glm::dvec3(0.0, 0.05 * t * t, 0.0));
        const glm::dvec3 v = axis * sin_turns(0.5 * turns * part);
        rotations.emplace_back(cos_turns(0.5 * turns * part), v.x, v.y, v.z);
    }
    animate_translation(document, node, times, places);
    animate_rotation(document, node, times, rotations);
}

}  // namespace

Document make_exploding(std::size_t triangles) {
    Document document{.name = "exploding"};
    const double reach = 1.2 * radius_m;
    const Shape whole = polygonise_to_count(
        {.distance = shell, .low = glm::dvec3(-reach), .high = glm::dvec3(reach)}, triangles, 0.5);

    Random random(5);
    std::vector<glm::dvec3> directions(std::clamp<std::size_t>(triangles / 500, 3, 240));
    for (glm::dvec3& d : directions) d = direction(random);
    const std::vector<Piece> pieces = cut(whole, break_up(whole, directions), directions.size());

    const Id material =
        append(document.materials, {.name = "shell", .roughness = 0.6, .glow = 0.06, .double_sided = true});
    std::vector<float> times;
    for (int key = 0; key <= key_count; ++key)
        times.push_back(static_cast<float>(duration_s * double(key) / key_count));
    const Id input = add_times(document, times);
    for (const Piece& piece : pieces) {
        if (piece.shape.triangles.empty()) continue;
        const std::string name = fmt::format("piece {}", document.meshes.size() + 1);
        const Id node =
            add_mesh_node(document, name, add_mesh(document, name, piece.shape, material), piece.middle);
        add_flight(document, node, random, input);
    }

    add_camera(document, {1.2, 1.3, 7.2}, {0.0, -0.15, 0.0}, 40.0, 50.0);
    add_light(document, "key", {-4.0, 6.0, 6.0}, {0.0, 0.0, 0.8}, 1.1, {1.0, 0.95, 0.88});
    return document;
}

}  // namespace gridreel::gallery
