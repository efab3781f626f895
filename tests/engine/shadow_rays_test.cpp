// Shadow rays from points chosen all over a surface: none is stopped by the surface that it belongs to, none
// overlooks what stands a hair's breadth above it.

#include "engine/shadow_rays.h"

#include "scenes.h"

#include <glm/geometric.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace gridreel;
using engine::PosedLight;
using traversal::TracerKind;

namespace {

constexpr double epsilon = std::numeric_limits<float>::epsilon();

/// Where a scene of about one unit is put.
struct Place {
    float scale = 1.0f;
    glm::vec3 shift{0.0f};  ///< in units

    [[nodiscard]] glm::vec3 of(const glm::vec3& point) const { return scale * (point + shift); }
};

/// From a millimetre to a thousand kilometres, and far from the origin.
const std::vector<Place>& places() {
    static const std::vector<Place> all{
        {1e-3f}, {1.0f}, {1e3f}, {1e6f}, {1.0f, {1000.0f, -2000.0f, 3000.0f}}};
    return all;
}

std::string describe(const Place& place) {
    return "scale " + std::to_string(place.scale) + ", shift " + std::to_string(place.shift.x);
}

/// One flat-shaded part.
anim::FrameGeometry placed(const anim::Primitive& shape, const Place& place) {
    anim::FrameGeometry geometry;
    for (const glm::vec3& position : shape.positions) geometry.positions.push_back(place.of(position));
    geometry.triangles = shape.triangles;
    geometry.triangle_part.resize(geometry.triangles.size(), 0);
    geometry.parts.resize(1);
    geometry.mirrored = {false};
    return geometry;
}

void append(anim::Primitive& shape, const anim::Primitive& other) {
    const auto first = static_cast<std::uint32_t>(shape.positions.size());
    shape.positions.insert(shape.positions.end(), other.positions.begin(), other.positions.end());
    for (const glm::uvec3& triangle : other.triangles) shape.triangles.push_back(triangle + first);
}

/// The height field y(x, z) over [-1, 1]^2, facing up.
template <class Height>
anim::Primitive field(int columns, int rows, const Height& height) {
    anim::Primitive shape;
    for (int i = 0; i <= rows; ++i) {
        for (int j = 0; j <= columns; ++j) {
            const float x = 2.0f * float(j) / float(columns) - 1.0f, z = 2.0f * float(i) / float(rows) - 1.0f;
            shape.positions.emplace_back(x, height(x, z), z);
        }
    }
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            const auto at = static_cast<std::uint32_t>(i * (columns + 1) + j);
            const auto below = at + static_cast<std::uint32_t>(columns + 1);
            shape.triangles.emplace_back(at, below, at + 1);
            shape.triangles.emplace_back(at + 1, below, below + 1);
        }
    }
    return shape;
}

anim::Primitive level(int side) {
    return field(side, side, [](float, float) { return 0.0f; });
}

/// The gallery's sheet, more or less: crests that shadow the troughs behind them.
anim::Primitive waves(int side) {
    return field(side, side,
                 [](float x, float z) { return 0.1f * std::sin(6.0f * x) + 0.08f * std::sin(9.0f * z); });
}

PosedLight lamp(const Place& place, const glm::vec3& position) {
    PosedLight light;
    light.position = place.of(position);
    return light;
}

PosedLight sun(const glm::vec3& towards) {
    PosedLight light;
    light.kind = anim::Light::Kind::directional;
    light.direction = -glm::normalize(towards);
    return light;
}

/// Towards the light, not normalised.
glm::dvec3 way_to(const PosedLight& light, const glm::dvec3& point) {
    return light.kind == anim::Light::Kind::directional ? -glm::dvec3(light.direction)
                                                        : glm::dvec3(light.position) - point;
}

/// A point of the front of a surface.
struct Point {
    std::uint32_t triangle = 0;
    glm::dvec3 position{0.0}, normal{0.0};  ///< of the triangle itself, unit
    engine::SurfaceShape shape;             ///< what the engine makes of it
};

/// Points that face the light, found by rays from above: inside triangles, on their edges and corners.
std::vector<Point> lit_points(const anim::FrameGeometry& geometry, const Place& place,
                              const PosedLight& light, std::size_t count) {
    // Triangles that face it. Those of no area, as where a sphere's finest round to lines, have no front.
    struct Facet {
        std::uint32_t triangle = 0;
        glm::dvec3 a{0.0}, ab{0.0}, ac{0.0}, normal{0.0};
    };
    std::vector<Facet> facets;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        const glm::uvec3& corners = geometry.triangles[i];
        Facet facet{.triangle = i, .a = glm::dvec3(geometry.positions[corners.x])};
        facet.ab = glm::dvec3(geometry.positions[corners.y]) - facet.a;
        facet.ac = glm::dvec3(geometry.positions[corners.z]) - facet.a;
        const glm::dvec3 normal = glm::cross(facet.ab, facet.ac);
        if (!(glm::dot(normal, way_to(light, facet.a)) > 0.0)) continue;
        facet.normal = glm::normalize(normal);
        facets.push_back(facet);
    }
    REQUIRE(!facets.empty());

    std::mt19937_64 random(5);
    const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Facet& facet = facets[random() % facets.size()];
        double b = uniform(), c = uniform() * (1.0 - b);
        if (i % 8 == 0) b = 0.0;
        if (i % 16 == 0) c = 0.0;
        const glm::dvec3 aim = facet.a + b * facet.ab + c * facet.ac;
        const glm::dvec3 aside(uniform() - 0.5, uniform() - 0.5, uniform() - 0.5);
        engine::Ray ray{.origin = glm::vec3(aim + double(place.scale) * (facet.normal + aside)),
                        .direction = {}};
        ray.direction = glm::vec3(aim) - ray.origin;
        const engine::HitPoint hit = engine::hit_point(geometry, facet.triangle, ray);
        const Point point{.triangle = facet.triangle,
                          .position = hit.position,
                          .normal = facet.normal,
                          .shape = engine::shape_at(geometry, facet.triangle, hit, ray)};
        if (engine::may_light(light, point.shape)) points.push_back(point);
    }
    return points;
}

/// Whether the tracer stops each point's shadow ray.
traversal::OcclusionBatch shadows(TracerKind kind, const anim::FrameGeometry& geometry,
                                  const PosedLight& light, const std::vector<Point>& points) {
    traversal::RayBatch rays;
    engine::begin_shadow_rays(light, points.size(), rays);
    for (std::size_t i = 0; i < points.size(); ++i) engine::set_shadow_ray(light, points[i].shape, i, rays);
    const auto tracer = traversal::make_tracer({.kind = kind, .resolution = {}});
    tracer->rebuild({geometry.positions, geometry.triangles});
    traversal::OcclusionBatch blocked;
    tracer->any_hits(rays, blocked);
    return blocked;
}

std::ptrdiff_t shadowed(TracerKind kind, const anim::FrameGeometry& geometry, const PosedLight& light,
                        const std::vector<Point>& points) {
    const auto blocked = shadows(kind, geometry, light, points);
    return std::count(blocked.begin(), blocked.end(), std::uint8_t{1});
}

/// What becomes of a shadow ray in double precision, looked up triangle by triangle.
enum class Truth { lit, shadowed, in_doubt };

/// In doubt is what passes an edge, or meets a triangle not yet above the point's own plane, by less than
/// rounding moves things: that of places, and of the way to the light. But triangles so low that face the
/// light are the point's neighbours, which it lies on as well: nothing leaves a surface through its front.
Truth truth_of(const anim::FrameGeometry& geometry, const Point& point, const PosedLight& light) {
    const bool directional = light.kind == anim::Light::Kind::directional;
    const glm::dvec3 way = way_to(light, point.position);
    const double far_end = directional ? std::numeric_limits<double>::infinity() : 1.0;
    const double tolerance =
        16.0 * epsilon * (double(point.shape.coordinate) + (directional ? 0.0 : glm::length(way)));
    Truth truth = Truth::lit;
    for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
        if (i == point.triangle) continue;
        const glm::uvec3& corners = geometry.triangles[i];
        const glm::dvec3 a = glm::dvec3(geometry.positions[corners.x]) - point.position;
        const glm::dvec3 b = glm::dvec3(geometry.positions[corners.y]) - point.position;
        const glm::dvec3 c = glm::dvec3(geometry.positions[corners.z]) - point.position;
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double facing = glm::dot(normal, way);
        if (facing == 0.0) continue;
        const double t = glm::dot(normal, a) / facing;
        if (!(t >= 0.0 && t < far_end)) continue;

        double clearance = std::numeric_limits<double>::infinity();
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            const glm::dvec3 between = glm::cross(to - from, way);
            const double distance = glm::dot(from, between) / glm::length(between);
            clearance = std::min(clearance, facing > 0.0 ? distance : -distance);
        }
        if (clearance < -tolerance) continue;
        const bool low = t * glm::dot(way, point.normal) <= tolerance;
        if (low && facing > 0.0) continue;
        if (!low && clearance > tolerance) return Truth::shadowed;
        truth = Truth::in_doubt;
    }
    return truth;
}

struct Verdict {
    std::size_t lit = 0, shadowed = 0;  ///< points beyond doubt
    std::size_t acne = 0;               ///< of the lit ones, found shadowed
    std::size_t leaks = 0;              ///< of the shadowed ones, found lit
};

Verdict verdict(const anim::FrameGeometry& geometry, const PosedLight& light,
                const std::vector<Point>& points) {
    const auto blocked = shadows(TracerKind::grid, geometry, light, points);
    Verdict found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Truth truth = truth_of(geometry, points[i], light);
        found.lit += truth == Truth::lit;
        found.shadowed += truth == Truth::shadowed;
        found.acne += truth == Truth::lit && blocked[i] != 0;
        found.leaks += truth == Truth::shadowed && blocked[i] == 0;
    }
    return found;
}

}  // namespace

TEST_CASE("no point of a sloping plane is in its own shadow, were it of slivers", "[engine][acne]") {
    const glm::vec3 up = glm::normalize(glm::vec3{-0.37f, 1.0f, -0.21f});
    const auto slope = [](float x, float z) { return 0.37f * x + 0.21f * z; };
    for (const Place& place : places()) {
        for (const auto& [columns, rows] :
             {std::pair(1, 1), std::pair(50, 50), std::pair(50, 1), std::pair(1, 700)}) {
            const anim::FrameGeometry plane = placed(field(columns, rows, slope), place);
            for (const float height : {1e-4f, 1e-2f, 1.0f, 1e3f}) {
                for (const bool directional : {false, true}) {
                    // Above a point of the plane beside the middle.
                    const glm::vec3 position = glm::vec3{0.3f, slope(0.3f, -0.2f), -0.2f} + height * up;
                    const PosedLight light = directional ? sun(position) : lamp(place, position);
                    const auto points = lit_points(plane, place, light, 2000);
                    INFO(describe(place) << ", " << columns << " x " << rows << ", light at height " << height
                                         << (directional ? ", far" : ""));
                    CHECK(points.size() > 1900);
                    CHECK(shadowed(TracerKind::grid, plane, light, points) == 0);
                }
            }
        }
    }
}

TEST_CASE("no point of a sphere that faces the light is in its own shadow", "[engine][acne]") {
    for (const Place& place : places()) {
        for (const int rings : {6, 60}) {
            const anim::FrameGeometry ball = placed(test::sphere(glm::vec3(0.0f), 1.0f, rings, false), place);
            for (const float distance : {1.001f, 1.3f, 5.0f, 1e3f}) {
                for (const bool directional : {false, true}) {
                    const glm::vec3 position = distance * glm::normalize(glm::vec3{0.5f, 0.7f, distance});
                    const PosedLight light = directional ? sun(position) : lamp(place, position);
                    const auto points = lit_points(ball, place, light, 4000);
                    INFO(describe(place) << ", " << rings << " rings, light " << distance << " away");
                    CHECK(points.size() > 3900);
                    CHECK(shadowed(TracerKind::grid, ball, light, points) == 0);
                    CHECK(shadowed(TracerKind::grid_single, ball, light, points) == 0);
                }
            }
        }
    }
}

TEST_CASE("waves shadow each other as in double precision", "[engine][acne]") {
    std::size_t in_shadow = 0;
    for (const Place& place : places()) {
        const anim::FrameGeometry sheet = placed(waves(24), place);
        for (const glm::vec3& position :
             {glm::vec3{0.3f, 0.25f, -0.2f}, glm::vec3{-3.0f, 0.5f, 2.0f}, glm::vec3{9.0f, 30.0f, 4.0f}}) {
            for (const bool directional : {false, true}) {
                const PosedLight light = directional ? sun(position) : lamp(place, position);
                const auto points = lit_points(sheet, place, light, 800);
                const Verdict found = verdict(sheet, light, points);
                INFO(describe(place) << ", light at height " << position.y << (directional ? ", far" : ""));
                // Far from the origin, triangles are but ten times as large as what rounding moves.
                const bool far_away = place.shift != glm::vec3(0.0f);
                CHECK(found.lit + found.shadowed > points.size() * (far_away ? 4 : 9) / 10);
                CHECK(found.acne == 0);
                CHECK(found.leaks == 0);
                in_shadow += found.shadowed;
            }
        }
    }
    CHECK(in_shadow > 2000);
}

TEST_CASE("a plate a ten-thousandth of its size above a plane shadows it", "[engine][acne]") {
    for (const Place& place : places()) {
        // Far from the origin, as near as floats allow.
        const bool far_away = place.shift != glm::vec3(0.0f);
        const float gap = far_away ? 1e-2f : 1e-4f;
        for (const int side : {1, 12}) {
            anim::Primitive shape = level(side);
            append(shape, test::quad({-0.5f, gap, 0.5f}, {0.5f, gap, 0.5f}, {0.5f, gap, -0.5f},
                                     {-0.5f, gap, -0.5f}));
            const anim::FrameGeometry geometry = placed(shape, place);
            for (const glm::vec3& position :
                 {glm::vec3{0.1f, 0.3f, 0.2f}, glm::vec3{2.0f, 2.0f, -1.0f}, glm::vec3{-3.0f, 9.0f, 1.0f}}) {
                for (const bool directional : {false, true}) {
                    const PosedLight light = directional ? sun(position) : lamp(place, position);
                    const auto points = lit_points(geometry, place, light, 600);
                    const Verdict found = verdict(geometry, light, points);
                    INFO(describe(place)
                         << ", light at height " << position.y << (directional ? ", far" : ""));
                    CHECK(found.lit + found.shadowed > points.size() * 9 / 10);
                    CHECK(found.shadowed > 50);
                    CHECK(found.acne == 0);
                    CHECK(found.leaks == 0);
                }
            }
        }
    }
}

TEST_CASE("shadows of a scene scaled by a power of two are the same, ray by ray", "[engine][acne]") {
    // Then floats differ in nothing but their exponents: a length in metres anywhere would show.
    anim::Primitive shape = waves(40);
    append(shape, test::sphere({0.2f, 0.2f, 0.1f}, 0.15f, 20, false));
    const auto shadows_at = [&](float scale, bool directional) {
        const Place place{.scale = scale};
        const anim::FrameGeometry geometry = placed(shape, place);
        const PosedLight light = directional ? sun({1.0f, 0.3f, 0.4f}) : lamp(place, {1.0f, 0.6f, 0.4f});
        const auto points = lit_points(geometry, place, light, 20'000);
        const auto blocked = shadows(TracerKind::grid, geometry, light, points);
        return std::vector<std::uint8_t>(blocked.begin(), blocked.end());
    };
    for (const bool directional : {false, true}) {
        const auto expected = shadows_at(1.0f, directional);
        const auto in_shadow = std::count(expected.begin(), expected.end(), std::uint8_t{1});
        CHECK(expected.size() > 19'000);
        CHECK(in_shadow > 1000);
        CHECK(in_shadow < 19'000);
        for (const float scale : {0x1p-10f, 0x1p-1f, 0x1p10f, 0x1p20f}) {
            INFO("scale " << scale);
            CHECK((shadows_at(scale, directional) == expected));
        }
    }
}
