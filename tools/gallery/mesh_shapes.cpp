#include "tools/gallery/mesh_shapes.h"

#include "tools/gallery/packing.h"
#include "tools/gallery/turns.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

namespace gridreel::gallery {

namespace {

constexpr double golden = 1.618033988749895;

constexpr std::array<std::array<double, 3>, 12> icosahedron_corners{{{-1, golden, 0},
                                                                     {1, golden, 0},
                                                                     {-1, -golden, 0},
                                                                     {1, -golden, 0},
                                                                     {0, -1, golden},
                                                                     {0, 1, golden},
                                                                     {0, -1, -golden},
                                                                     {0, 1, -golden},
                                                                     {golden, 0, -1},
                                                                     {golden, 0, 1},
                                                                     {-golden, 0, -1},
                                                                     {-golden, 0, 1}}};

constexpr std::array<std::array<std::uint32_t, 3>, 20> icosahedron_faces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

/// A point of a face as (corner, steps towards it) pairs; the same point met from two faces has the same key.
using Lattice = std::array<std::pair<std::uint32_t, std::uint32_t>, 3>;

Lattice lattice_key(const std::array<std::uint32_t, 3>& face, std::uint32_t a, std::uint32_t b,
                    std::uint32_t c) {
    Lattice key{{{face[0], a}, {face[1], b}, {face[2], c}}};
    for (auto& [corner, steps] : key)
        if (steps == 0) corner = 12;
    std::ranges::sort(key);
    return key;
}

/// Corners of a quad seen counter-clockwise.
void add_quad(Shape& shape, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    shape.triangles.emplace_back(a, b, c);
    shape.triangles.emplace_back(a, c, d);
}

/// The outward direction of a profile's segment: its right-hand side.
glm::dvec2 right_of(const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 along = to - from;
    return glm::normalize(glm::dvec2(along.y, -along.x));
}

/// Profile normals: the mean of the two segments that meet, one segment's at ends and creases.
std::vector<glm::dvec2> profile_normals(std::span<const glm::dvec2> profile) {
    std::vector<glm::dvec2> normals(profile.size(), glm::dvec2(0.0));
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        if (profile[i] == profile[i + 1]) continue;
        const glm::dvec2 normal = right_of(profile[i], profile[i + 1]);
        normals[i] += normal;
        normals[i + 1] += normal;
    }
    for (glm::dvec2& normal : normals) normal = glm::normalize(normal);
    return normals;
}

}  // namespace

Shape geodesic_sphere(std::uint32_t frequency, double radius_m) {
    assert(frequency >= 1);
    Shape sphere;
    std::map<Lattice, std::uint32_t> vertex_of;
    for (const auto& face : icosahedron_faces) {
        const auto vertex = [&](std::uint32_t b, std::uint32_t c) {
            const std::uint32_t a = frequency - b - c;
            const Lattice key = lattice_key(face, a, b, c);
            const auto [entry, is_new] =
                vertex_of.try_emplace(key, static_cast<std::uint32_t>(sphere.positions.size()));
            if (is_new) {
                // Summed in the key's order, so that the point does not depend on the face.
                glm::dvec3 p(0.0);
                for (const auto& [corner, steps] : key) {
                    if (steps == 0) continue;
                    const auto& xyz = icosahedron_corners[corner];
                    p += double(steps) * glm::dvec3(xyz[0], xyz[1], xyz[2]);
                }
                const glm::dvec3 normal = glm::normalize(p);
                sphere.positions.emplace_back(radius_m * normal);
                sphere.normals.emplace_back(normal);
            }
            return entry->second;
        };
        for (std::uint32_t row = 0; row < frequency; ++row)
            for (std::uint32_t i = 0; i + row < frequency; ++i) {
                // Named one by one: vertices are numbered in the order of these calls.
                const std::uint32_t left = vertex(i, row), right = vertex(i + 1, row),
                                    top = vertex(i, row + 1);
                sphere.triangles.emplace_back(left, right, top);
                if (i + row + 1 < frequency)
                    sphere.triangles.emplace_back(right, vertex(i + 1, row + 1), top);
            }
    }
    return sphere;
}

Shape lathe(std::span<const glm::dvec2> profile, std::uint32_t sectors) {
    assert(profile.size() >= 2 && sectors >= 3);
    Shape turned;
    const std::vector<glm::dvec2> normals = profile_normals(profile);

    // Rings of vertices; a pole is a ring of one.
    std::vector<std::uint32_t> ring_begin;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        ring_begin.push_back(static_cast<std::uint32_t>(turned.positions.size()));
        const bool is_pole = profile[i].x == 0.0;
        for (std::uint32_t s = 0; s < (is_pole ? 1 : sectors); ++s) {
            const double turn = double(s) / double(sectors);
            const glm::dvec3 out(cos_turns(turn), 0.0, -sin_turns(turn));
            const double lean = is_pole ? 0.0 : normals[i].x;
            const double rise = is_pole ? (normals[i].y < 0.0 ? -1.0 : 1.0) : normals[i].y;
            turned.positions.emplace_back(profile[i].x * out + glm::dvec3(0.0, profile[i].y, 0.0));
            turned.normals.emplace_back(lean * out + glm::dvec3(0.0, rise, 0.0));
        }
    }

    // Bands between rings.
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        if (profile[i] == profile[i + 1]) continue;
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const auto at = [&](std::size_t ring, std::uint32_t sector) {
                return ring_begin[ring] + (profile[ring].x == 0.0 ? 0 : sector % sectors);
            };
            if (profile[i + 1].x != 0.0)
                turned.triangles.emplace_back(at(i, s), at(i + 1, s + 1), at(i + 1, s));
            if (profile[i].x != 0.0) turned.triangles.emplace_back(at(i, s), at(i, s + 1), at(i + 1, s + 1));
        }
    }
    return turned;
}

Shape box(const glm::dvec3& low, const glm::dvec3& high) {
    Shape shape;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const bool is_high : {false, true}) {
            glm::dvec3 normal(0.0);
            normal[axis] = is_high ? 1.0 : -1.0;
            const auto first = static_cast<std::uint32_t>(shape.positions.size());
            for (const auto& [at_u, at_v] :
                 {std::pair{false, false}, {true, false}, {true, true}, {false, true}}) {
                glm::dvec3 corner;
                corner[axis] = is_high ? high[axis] : low[axis];
                corner[u] = at_u ? high[u] : low[u];
                corner[v] = at_v ? high[v] : low[v];
                shape.positions.emplace_back(corner);
                shape.normals.emplace_back(normal);
            }
            if (is_high)
                add_quad(shape, first, first + 1, first + 2, first + 3);
            else
                add_quad(shape, first, first + 3, first + 2, first + 1);
        }
    }
    return shape;
}

Shape backdrop(const Backdrop& paper) {
    // The paper's edge as (z, y), from the floor's front to the wall's top, with its normals.
    const double bend = paper.bend_steps == 0 ? 0.0 : paper.bend_m;
    std::vector<std::pair<glm::dvec2, glm::dvec2>> edge{{{paper.front_z, 0.0}, {0.0, 1.0}}};
    for (std::uint32_t i = 0; i <= paper.bend_steps; ++i) {
        const double turn = paper.bend_steps == 0 ? 0.125 : 0.25 * double(i) / double(paper.bend_steps);
        const glm::dvec2 normal(sin_turns(turn), cos_turns(turn));
        edge.emplace_back(glm::dvec2(paper.wall_z + bend, bend) - bend * normal, normal);
    }
    edge.emplace_back(glm::dvec2(paper.wall_z, paper.height), glm::dvec2(1.0, 0.0));

    Shape shape;
    for (const auto& [point, normal] : edge)
        for (const double x : {-paper.half_width, paper.half_width}) {
            shape.positions.emplace_back(x, point.y, point.x);
            shape.normals.emplace_back(0.0, normal.y, normal.x);
        }
    for (std::uint32_t i = 0; i + 1 < edge.size(); ++i)
        add_quad(shape, 2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    return shape;
}

void join(Shape& whole, const Shape& part, const glm::dvec3& offset) {
    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    for (const glm::vec3& p : part.positions) whole.positions.emplace_back(glm::dvec3(p) + offset);
    whole.normals.insert(whole.normals.end(), part.normals.begin(), part.normals.end());
    whole.colors.insert(whole.colors.end(), part.colors.begin(), part.colors.end());
    for (const glm::uvec3& t : part.triangles) whole.triangles.push_back(t + first);
}

glm::u8vec4 color_bytes(const glm::dvec3& color) {
    const auto byte = [](double x) {
        return static_cast<std::uint8_t>(std::floor(std::clamp(x, 0.0, 1.0) * 255.0 + 0.5));
    };
    return {byte(color.x), byte(color.y), byte(color.z), 255};
}

void paint(Shape& shape, const glm::dvec3& color) {
    shape.colors.assign(shape.positions.size(), color_bytes(color));
}

Id add_mesh(Document& document, std::string name, const Shape& shape, Id material) {
    Mesh mesh{.name = std::move(name), .material = material};
    mesh.attributes = {{"POSITION", add_positions(document, shape.positions)},
                       {"NORMAL", add_normals(document, shape.normals)}};
    if (!shape.colors.empty()) mesh.attributes.emplace_back("COLOR_0", add_colors(document, shape.colors));
    mesh.indices = add_indices(document, shape.triangles, shape.positions.size());
    return append(document.meshes, std::move(mesh));
}

Id add_mesh_node(Document& document, std::string name, Id mesh, const glm::dvec3& translation) {
    return append(document.nodes, Node{.name = std::move(name), .translation = translation, .mesh = mesh});
}

}  // namespace gridreel::gallery
