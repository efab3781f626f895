// A ball of needles, each spinning about its own middle: long thin triangles, aslant in every grid.

#include "tools/gallery/loose_triangles.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/random.h"
#include "tools/gallery/scenes.h"
#include "tools/gallery/staging.h"
#include "tools/gallery/travelling_wave.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace gridreel::gallery {

namespace {

constexpr double duration_s = 6.0;
constexpr double aspect = 120.0;  ///< length over width
constexpr std::array<int, 3> turns{1, 2, 3};

/// Uniform in the ball, by rejection; never too near the middle to have a direction.
glm::dvec3 point_in_ball(Random& random) {
    for (;;) {
        const double x = random.between(-1.0, 1.0), y = random.between(-1.0, 1.0);
        const glm::dvec3 p(x, y, random.between(-1.0, 1.0));
        const double distance_2 = glm::dot(p, p);
        if (distance_2 <= 1.0 && distance_2 > 1e-4) return p;
    }
}

/// A needle at `middle` spins in a plane through it. A turn by the angle a about the unit axis k takes the
/// offset o to k (k.o) + cos a (o - k (k.o)) + sin a (k x o): two morph targets make it exact.
void add_needle(LooseTriangles& needles, Random& random, double length_m) {
    const glm::dvec3 middle = point_in_ball(random);
    const glm::dvec3 along = glm::normalize(point_in_ball(random));
    const glm::dvec3 axis = glm::normalize(glm::cross(along, point_in_ball(random)));
    // The flat side leans out of the plane of the spin, so that it is seen from everywhere.
    const glm::dvec3 side = glm::normalize(axis + glm::cross(axis, along));

    const double half_width = 0.5 * length_m / aspect;
    const std::array<glm::dvec3, 3> offsets{-0.5 * length_m * along - half_width * side,
                                            -0.5 * length_m * along + half_width * side,
                                            0.5 * length_m * along};
    const double shade = random.between(0.0, 1.0);
    const std::array<glm::dvec3, 3> colors{
        glm::dvec3(0.30, 0.16, 0.05), glm::dvec3(0.30, 0.16, 0.05),
        glm::mix(glm::dvec3(0.10, 0.42, 0.12), glm::dvec3(0.75, 0.80, 0.20), shade)};
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const glm::dvec3& offset = offsets[corner];
        const glm::dvec3 along_axis = axis * glm::dot(axis, offset);
        needles.corners.emplace_back(middle + along_axis);
        needles.targets[0].emplace_back(offset - along_axis);
        needles.targets[1].emplace_back(glm::cross(axis, offset));
        needles.colors.push_back(color_bytes(colors[corner]));
    }
}

}  // namespace

Document make_needles(std::size_t triangles) {
    Document document{.name = "needles"};
    const Id material =
        append(document.materials, {.name = "needle", .roughness = 0.5, .glow = 0.08, .double_sided = true});

    // The more, the shorter: about the same part of the picture is covered.
    const double length_m = std::min(0.8, 0.5 * std::sqrt(50'000.0 / double(triangles)));
    Random random(11);
    for (std::size_t group = 0; group < turns.size(); ++group) {
        const std::size_t count = (triangles + turns.size() - 1 - group) / turns.size();
        if (count == 0) continue;
        LooseTriangles needles{.targets = {{}, {}}, .weights = {1.0, 0.0}};
        for (std::size_t i = 0; i < count; ++i) add_needle(needles, random, length_m);
        const std::string name = fmt::format("needles {}", group + 1);
        const Id node = add_mesh_node(document, name, add_loose_mesh(document, name, needles, material));
        const std::array<int, 1> cycles{turns[group]};
        add_wave_weights(document, node, cycles, duration_s, 24 * cycles.front());
    }

    add_camera(document, {0.3, 0.9, 3.4}, {0.0, 0.0, 0.0}, 40.0, 50.0);
    add_light(document, "key", {-3.0, 4.0, 3.5}, {0.0, 0.3, 0.5}, 1.2, {1.0, 0.95, 0.86});
    return document;
}

}  // namespace gridreel::gallery
