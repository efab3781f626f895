#include "tools/gallery/figure.h"
#include "tools/gallery/mesh_shapes.h"
#include "tools/gallery/morph_surface.h"
#include "tools/gallery/packing.h"
#include "tools/gallery/surface_nets.h"
#include "tools/gallery/turns.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

using namespace gridreel::gallery;

namespace {

using EdgeUses = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

EdgeUses edge_uses(const Shape& shape) {
    EdgeUses uses;
    for (const glm::uvec3& t : shape.triangles)
        for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
    return uses;
}

/// Along every edge as many triangles run one way as the other.
bool has_no_holes(const Shape& shape) {
    const EdgeUses uses = edge_uses(shape);
    return std::ranges::all_of(uses, [&](const auto& use) {
        const auto back = uses.find({use.first.second, use.first.first});
        return back != uses.end() && back->second == use.second;
    });
}

/// Moreover, every edge has just two triangles.
bool is_closed(const Shape& shape) {
    return has_no_holes(shape) &&
           std::ranges::all_of(edge_uses(shape), [](const auto& use) { return use.second == 1; });
}

/// Six times the volume inside is the sum of the triangles' determinants.
double volume(const Shape& shape) {
    double sum = 0.0;
    for (const glm::uvec3& t : shape.triangles) {
        const glm::dvec3 a(shape.positions[t.x]), b(shape.positions[t.y]), c(shape.positions[t.z]);
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum / 6.0;
}

/// The part of the area whose triangles lean more than 60 degrees from their vertex normals.
double crumpled_part(const Shape& shape) {
    double crumpled = 0.0, whole = 0.0;
    for (const glm::uvec3& t : shape.triangles) {
        const glm::dvec3 a(shape.positions[t.x]), b(shape.positions[t.y]), c(shape.positions[t.z]);
        const glm::dvec3 face = glm::cross(b - a, c - a);
        const glm::dvec3 mean = glm::normalize(shape.normals[t.x] + shape.normals[t.y] + shape.normals[t.z]);
        const double area = glm::length(face);
        whole += area;
        if (glm::dot(face, mean) < 0.5 * area) crumpled += area;
    }
    return crumpled / whole;
}

constexpr double pi = 3.141592653589793;

Solid ball(double radius_m) {
    return {.distance = [=](const glm::dvec3& p) { return glm::length(p) - radius_m; },
            .low = glm::dvec3(-radius_m),
            .high = glm::dvec3(radius_m)};
}

}  // namespace

TEST_CASE("turns agree with the C library and close their loop exactly", "[gallery]") {
    double worst = 0.0;
    for (int i = -2000; i <= 2000; ++i) {
        const double x = 0.00137 * i;
        worst = std::max(worst, std::abs(sin_turns(x) - std::sin(2.0 * pi * x)));
        worst = std::max(worst, std::abs(cos_turns(x) - std::cos(2.0 * pi * x)));
    }
    CHECK(worst < 1e-14);
    CHECK(std::abs(sin_turns(0.25) - 1.0) < 1e-15);
    CHECK(sin_turns(1.0) == 0.0);
    CHECK(sin_turns(0.375 + 3.0) == sin_turns(0.375));
}

TEST_CASE("a geodesic sphere is closed, round and has 20 f² triangles", "[gallery]") {
    for (const std::uint32_t f : {1u, 2u, 5u}) {
        const Shape sphere = geodesic_sphere(f, 2.0);
        CHECK(sphere.triangles.size() == 20 * f * f);
        CHECK(sphere.positions.size() == 10 * f * f + 2);
        CHECK(is_closed(sphere));
        for (const glm::vec3& p : sphere.positions) CHECK(glm::length(p) == Approx(2.0).epsilon(1e-6));
    }
    CHECK(volume(geodesic_sphere(20, 1.0)) == Approx(4.0 / 3.0 * pi).epsilon(0.01));
}

TEST_CASE("a turned profile is closed from pole to pole and faces outwards", "[gallery]") {
    // A cone, point up, and its floor: volume pi/3 in the limit of many sectors.
    const std::vector<glm::dvec2> profile{{0, 0}, {1, 0}, {0, 1}};
    const Shape cone = lathe(profile, 64);
    CHECK(is_closed(cone));
    CHECK(volume(cone) == Approx(pi / 3.0).epsilon(0.002));
}

TEST_CASE("a box has its volume, and flat faces that look outwards", "[gallery]") {
    const Shape shape = box({-1, 0, 2}, {1, 3, 2.5});
    CHECK(shape.triangles.size() == 12);
    CHECK(volume(shape) == Approx(3.0));
    CHECK(crumpled_part(shape) == 0.0);
}

TEST_CASE("a backdrop faces the camera and has the triangles it promises", "[gallery]") {
    for (const std::uint32_t steps : {0u, 6u}) {
        const Shape paper = backdrop({.bend_steps = steps});
        CHECK(paper.triangles.size() == 2 * (steps + 2));
        CHECK(crumpled_part(paper) == 0.0);
    }
}

TEST_CASE("surface nets close a ball, on its surface, with its normals", "[gallery]") {
    const Shape net = polygonise(ball(0.5), 0.04);
    CHECK(is_closed(net));
    CHECK(volume(net) == Approx(pi / 6.0).epsilon(0.02));
    for (std::size_t i = 0; i < net.positions.size(); ++i) {
        CHECK(glm::length(net.positions[i]) == Approx(0.5).epsilon(1e-4));
        CHECK(glm::dot(glm::normalize(net.positions[i]), net.normals[i]) > 0.9999f);
    }
}

TEST_CASE("surface nets meet a wanted number of triangles", "[gallery]") {
    for (const std::size_t wanted : {1'500u, 30'000u}) {
        const double count = double(polygonise_to_count(ball(0.5), wanted, 0.3).triangles.size());
        CHECK(std::abs(count - double(wanted)) <= 0.02 * double(wanted));
    }
}

TEST_CASE("the figure has no holes, is as tall as a person, and every vertex is bound", "[gallery]") {
    const SkinnedShape figure = make_figure(12'000);
    CHECK(has_no_holes(figure.shape));
    CHECK(crumpled_part(figure.shape) < 1e-3);

    float lowest = 10.0f, highest = 0.0f;
    for (const glm::vec3& p : figure.shape.positions) {
        lowest = std::min(lowest, p.y);
        highest = std::max(highest, p.y);
    }
    CHECK(std::abs(lowest) < 0.01f);
    CHECK(highest == Approx(1.83).margin(0.05));
    for (std::size_t i = 0; i < figure.weights.size(); ++i) {
        const glm::uvec4 weights(figure.weights[i]), joints(figure.joints[i]);
        CHECK(weights.x + weights.y + weights.z + weights.w == 65535);
        CHECK(std::max({joints.x, joints.y, joints.z, joints.w}) < joint_count);
        CHECK(weights.x >= weights.y);
    }
}

TEST_CASE("an ankle's skin belongs to shin and foot, not to the other leg", "[gallery]") {
    const SkinnedShape figure = make_figure(8'000);
    bool met = false;
    for (std::size_t i = 0; i < figure.weights.size(); ++i) {
        const glm::vec3& p = figure.shape.positions[i];
        if (p.y > 0.12f || p.z < 0.0f) continue;
        met = true;
        for (int k = 0; k < 4; ++k)
            if (figure.weights[i][k] > 0) {
                CHECK(figure.joints[i][k] >= shin_right);
                CHECK(figure.joints[i][k] <= toes_right);
            }
    }
    CHECK(met);
}

TEST_CASE("a grid has about the triangles asked for, with quads about square", "[gallery]") {
    for (const std::size_t wanted : {1'000u, 10'000u, 1'000'000u}) {
        const GridSize size = choose_grid(wanted, 2.0, 1);
        CHECK(std::abs(2.0 * size.columns * size.rows - double(wanted)) <= 0.01 * double(wanted));
        CHECK(double(size.columns) / size.rows == Approx(2.0).epsilon(0.12));
    }
    CHECK(choose_grid(1, 9.0, 3).columns >= 3);
    CHECK(choose_grid(1, 9.0, 3).rows == 3);
}

TEST_CASE("a morph target's normals turn the surface's normal as its displacement does", "[gallery]") {
    // A flat square facing +z; its one target lifts it by x²/2, so that the slope at x is x.
    const MorphSurface surface{.at =
                                   [](double u, double v, std::span<glm::dvec3> out) {
                                       out[0] = {u, v, 0.0};
                                       out[1] = {0.0, 0.0, 0.5 * u * u};
                                   },
                               .color = [](double, double) { return glm::dvec3(1.0); },
                               .target_count = 1};
    Document document;
    append(document.materials, {.name = "white"});
    const Id id = add_morph_mesh(document, "square", surface, {.columns = 4, .rows = 4}, 0);
    const Mesh& mesh = document.meshes[id];
    const auto vector = [&](const Attributes& attributes, std::size_t attribute, std::size_t vertex) {
        glm::vec3 v;
        std::memcpy(&v, document.accessors[attributes[attribute].second].bytes.data() + 12 * vertex, 12);
        return v;
    };
    for (std::size_t vertex = 0; vertex < 25; ++vertex) {
        const glm::vec3 base = vector(mesh.attributes, 1, vertex),
                        change = vector(mesh.targets[0], 1, vertex);
        const float x = vector(mesh.attributes, 0, vertex).x;
        CHECK(base.z == Approx(1.0));
        CHECK(change.x == Approx(-x).margin(1e-6));
        CHECK(std::abs(change.y) < 1e-6f);
    }
}
