#pragma once
// Triangles to trace against: pleasant and nasty.

#include "rebuild/triangle_view.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gridreel::tests {

/// A small deterministic generator of uniform numbers (PCG, O'Neill 2014).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed * 2 + 1) { (void)next(); }
    std::uint32_t next();
    float uniform(float low, float high);
    glm::vec3 in_box(float low, float high);
    glm::vec3 on_sphere();

private:
    std::uint64_t state_;
};

struct Triangles {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;

    [[nodiscard]] rebuild::TriangleView view() const { return {positions, triangles}; }
    void add(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
};

Triangles soup(std::size_t count, float size);  ///< random triangles in [-1, 1]^3
Triangles sheet(int side);                      ///< a waving height field over [-1, 1]^2, shared vertices
Triangles sphere(int rings);                    ///< closed, radius 1
Triangles slivers(std::size_t count);           ///< aspect 1000 and more, every direction
Triangles coplanar(std::size_t count);          ///< overlapping triangles in z = 0, many at equal depth
Triangles boxes(int side);                      ///< axis-aligned faces on whole coordinates
Triangles degenerate(std::size_t count);        ///< points, lines, NaN, infinities and a few good ones

/// A small dense sphere in a huge box.
Triangles teapot_in_stadium();

/// Small triangles amid thirty times larger ones, three times over: grids within grids within grids.
Triangles crowds_in_crowds();
Triangles scaled(Triangles triangles, float factor, const glm::vec3& shift);

}  // namespace gridreel::tests
