#pragma once
// Shapes that stand around: geodesic spheres, turned profiles, boxes, the studio backdrop.

#include "tools/gallery/document.h"

#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace gridreel::gallery {

/// A triangle mesh, counter-clockwise seen from outside. Metres; y up.
struct Shape {
    std::vector<glm::vec3> positions{};
    std::vector<glm::vec3> normals{};   ///< unit, per vertex
    std::vector<glm::u8vec4> colors{};  ///< linear RGBA per vertex, or empty
    std::vector<glm::uvec3> triangles{};
};

/// An icosahedron whose faces are split into `frequency`² triangles: 20 frequency² in all,
/// 10 frequency² + 2 vertices (class I geodesic sphere).
[[nodiscard]] Shape geodesic_sphere(std::uint32_t frequency, double radius_m);

/// Turns a profile about the y axis. The outside is on the right of the profile's direction, seen with
/// the radius to the right and y up: from the bottom up for a vase, inwards for a floor.
/// A profile point at radius 0 becomes one pole.
///
/// @param profile  (radius, height) pairs, radius >= 0, at least two; repeat a point for a sharp crease
/// @param sectors  >= 3
[[nodiscard]] Shape lathe(std::span<const glm::dvec2> profile, std::uint32_t sectors);

/// An axis-aligned box: 12 triangles, flat faces.
[[nodiscard]] Shape box(const glm::dvec3& low, const glm::dvec3& high);

/// A photographer's paper: a floor that curves up into a wall, x from -half_width to half_width,
/// facing +y and +z.
///
/// @param front_z  near edge of the floor; @param wall_z  the wall, < front_z - bend_m
/// @param bend_m   radius of the curve; @param bend_steps  0: floor and wall meet in a corner
/// 2 (bend_steps + 2) triangles.
struct Backdrop {
    double half_width = 4.0, front_z = 3.0, wall_z = -3.0, height = 4.0, bend_m = 1.0;
    std::uint32_t bend_steps = 8;
};
[[nodiscard]] Shape backdrop(const Backdrop& paper);

/// Moves, then appends `part` to `whole` (colours included when both have them).
void join(Shape& whole, const Shape& part, const glm::dvec3& offset = glm::dvec3(0.0));

/// Paints every vertex.
void paint(Shape& shape, const glm::dvec3& color);

/// Linear RGB in [0, 1] as normalised bytes.
[[nodiscard]] glm::u8vec4 color_bytes(const glm::dvec3& color);

/// Adds the shape as a mesh.
[[nodiscard]] Id add_mesh(Document& document, std::string name, const Shape& shape, Id material);

/// Adds a node that shows the mesh.
Id add_mesh_node(Document& document, std::string name, Id mesh,
                 const glm::dvec3& translation = glm::dvec3(0.0));

}  // namespace gridreel::gallery
