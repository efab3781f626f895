// The kernels that place vertices, bit for bit against one vertex after another, with every instruction set.

#include "anim/rigid_kernel.h"
#include "anim/skin_kernel.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x4.hpp>

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace gridreel::anim {
namespace {

// --- Random input ------------------------------------------------------------------------------

/// How likely a number is one of those that break formulas.
enum class Nastiness { none, some, much };

class Dice {
public:
    Dice(std::uint32_t seed, Nastiness nastiness) : engine_(seed), nastiness_(nastiness) {}

    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }

    float number() {
        const float plain = (float(engine_() >> 8) * 0x1p-23f - 1.0f) * 2.0f;
        return is_nasty() ? nasty(plain) : plain;
    }

    glm::vec3 vector() {
        const float x = number(), y = number(), z = number();
        const glm::vec3 v{x, y, z};
        if (!is_nasty()) return v;
        // All of it at once, as files have it: no normal at all, or one in another unit.
        constexpr float scales[]{0.0f, 1e-42f, 1e-30f, 1e30f, 3e38f};
        return v * scales[below(5)];
    }

private:
    bool is_nasty() {
        return nastiness_ != Nastiness::none && below(nastiness_ == Nastiness::much ? 6 : 200) == 0;
    }

    float nasty(float plain) {
        const float infinity = std::numeric_limits<float>::infinity();
        const float choices[]{
            0.0f,          -0.0f, 1e-45f,   plain * 1e-41f, plain * 1e-25f,
            plain * 1e25f, 3e38f, infinity, -infinity,      std::numeric_limits<float>::quiet_NaN()};
        return choices[below(10)];
    }

    std::mt19937 engine_;
    Nastiness nastiness_;
};

struct Attributes {
    bool normals = true, tangents = true;
};

/// A primitive's vertices, its skin, and where both go.
struct Part {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    Influences influences;
    std::vector<AffineRows> maps;
    Placement placement;
};

AffineRows random_map(Dice& dice) {
    AffineRows map;
    for (int r = 0; r < 3; ++r) map.row[std::size_t(r)] = glm::vec4{dice.vector(), dice.number()};
    // Flat, and mirrored.
    if (dice.below(8) == 0) map.row[dice.below(3)] = glm::vec4{0.0f};
    if (dice.below(4) == 0) map.row[0] = -map.row[0];
    return map;
}

Part random_part(std::uint32_t seed, Nastiness nastiness, std::size_t vertices, std::uint32_t per_vertex,
                 const Attributes& attributes) {
    Dice dice(seed, nastiness);
    Part part;
    for (std::size_t v = 0; v < vertices; ++v) {
        part.positions.push_back(dice.vector());
        if (attributes.normals) part.normals.push_back(dice.vector());
        if (attributes.tangents) part.tangents.emplace_back(dice.vector(), dice.below(2) == 0 ? 1.0f : -1.0f);
    }
    const std::uint32_t joints = 1 + dice.below(9);
    for (std::uint32_t j = 0; j < joints; ++j) part.maps.push_back(random_map(dice));
    part.influences.per_vertex = per_vertex;
    for (std::size_t i = 0; i < vertices * per_vertex; ++i) {
        part.influences.joints.push_back(static_cast<std::uint16_t>(dice.below(joints)));
        part.influences.weights.push_back(dice.below(4) == 0 ? 0.0f : std::abs(dice.number()));
    }
    const auto rows = [](const AffineRows& map) {
        return glm::mat3{glm::vec3{map.row[0]}, glm::vec3{map.row[1]}, glm::vec3{map.row[2]}};
    };
    Dice plain(seed, Nastiness::none);
    part.placement = {
        .centre = plain.vector(), .origin = plain.vector(), .directions = direction_map(rows(part.maps[0]))};
    return part;
}

// --- The oracle --------------------------------------------------------------------------------

struct Placed {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
};

void place_vertex(const Placement& placement, const glm::mat3x4& rows, const DirectionMap& directions,
                  const Part& part, std::size_t v, Placed& out) {
    const glm::vec3 position = part.positions[v] - placement.centre;
    out.positions.push_back(placement.origin + glm::vec4{position, 1.0f} * rows);
    if (!part.normals.empty()) out.normals.push_back(map_normal(directions, part.normals[v]));
    if (part.tangents.empty()) return;
    const glm::vec4 tangent = part.tangents[v];
    out.tangents.emplace_back(map_tangent(directions, glm::vec3{tangent}), tangent.w * directions.handedness);
}

glm::mat3x4 rows_of(const AffineRows& map) {
    return {map.row[0], map.row[1], map.row[2]};
}

Placed place_skinned_singly(const Part& part, std::size_t first, std::size_t count) {
    Placed out;
    const std::size_t per_vertex = part.influences.per_vertex;
    for (std::size_t v = first; v < first + count; ++v) {
        glm::mat3x4 sum{0.0f};
        for (std::size_t i = v * per_vertex; i < (v + 1) * per_vertex; ++i) {
            const glm::mat3x4 weighted =
                part.influences.weights[i] * rows_of(part.maps[part.influences.joints[i]]);
            sum = i == v * per_vertex ? weighted : sum + weighted;
        }
        const glm::mat3 linear{glm::vec3{sum[0]}, glm::vec3{sum[1]}, glm::vec3{sum[2]}};
        place_vertex(part.placement, sum, direction_map(linear), part, v, out);
    }
    return out;
}

Placed place_rigid_singly(const Part& part, std::size_t first, std::size_t count) {
    Placed out;
    for (std::size_t v = first; v < first + count; ++v)
        place_vertex(part.placement, rows_of(part.maps[0]), part.placement.directions, part, v, out);
    return out;
}

// --- The kernels -------------------------------------------------------------------------------

enum class Kernel { skinned, rigid };
enum class Place { elsewhere, in_place };

constexpr std::size_t fence = 40;  ///< vertices on both sides of a run, which belong to others

template <class Vector>
std::span<const Vector> some(const std::vector<Vector>& all, std::size_t first, std::size_t count) {
    return all.empty() ? std::span<const Vector>{} : std::span{all}.subspan(first, count);
}

/// As many as `from`, between fences.
template <class Vector>
class Fenced {
public:
    Fenced(std::span<const Vector> from, Place place)
        : count_(from.size()), all_(count_ + 2 * fence, mark()) {
        if (place == Place::in_place) std::copy(from.begin(), from.end(), run().begin());
    }

    std::span<Vector> run() { return std::span{all_}.subspan(fence, count_); }

    [[nodiscard]] std::vector<Vector> content() {
        const auto intact = [](const Vector& v) { return v == mark(); };
        CHECK(std::all_of(all_.begin(), all_.begin() + fence, intact));
        CHECK(std::all_of(all_.end() - fence, all_.end(), intact));
        return {run().begin(), run().end()};
    }

private:
    static Vector mark() { return Vector{-77.0f}; }

    std::size_t count_;
    std::vector<Vector> all_;
};

/// Places the vertices [first, first + count) by a kernel, which sees nothing of what surrounds them.
Placed place(Kernel kernel, const Part& part, std::size_t first, std::size_t count, Place where) {
    // Exactly as long as the run, so that sanitizers see what reads behind it.
    const auto copy = [&](const auto& all) {
        const auto run = some(all, first, count);
        return std::vector(run.begin(), run.end());
    };
    const auto positions = copy(part.positions), normals = copy(part.normals);
    const auto tangents = copy(part.tangents);
    Fenced<glm::vec3> to_positions(positions, where), to_normals(normals, where);
    Fenced<glm::vec4> to_tangents(tangents, where);
    ShapeSpans from{.positions = positions, .normals = normals, .tangents = tangents};
    const VertexSpans to{
        .positions = to_positions.run(), .normals = to_normals.run(), .tangents = to_tangents.run()};
    if (where == Place::in_place) from = {to.positions, to.normals, to.tangents};
    from.centre = part.placement.centre;
    if (kernel == Kernel::skinned) {
        place_skinned(part.placement, part.maps, part.influences, first, from, to);
    } else {
        place_rigid(part.placement, part.maps[0], from, to);
    }
    return {to_positions.content(), to_normals.content(), to_tangents.content()};
}

/// Which of several not-a-numbers an operation hands on differs between machines.
template <class Vector>
bool same_bits(const std::vector<Vector>& a, const std::vector<Vector>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Vector& v, const Vector& w) {
        for (glm::length_t i = 0; i < Vector::length(); ++i) {
            const bool both_undefined = std::isnan(v[i]) && std::isnan(w[i]);
            if (!both_undefined && std::bit_cast<std::uint32_t>(v[i]) != std::bit_cast<std::uint32_t>(w[i]))
                return false;
        }
        return true;
    });
}

bool same_bits(const Placed& a, const Placed& b) {
    return same_bits(a.positions, b.positions) && same_bits(a.normals, b.normals) &&
           same_bits(a.tangents, b.tangents);
}

/// Only the SIMD target with this bit; 0: the best.
void use_target(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Whether all instruction sets give the oracle's bits, both in place and from elsewhere.
void check(Kernel kernel, const Part& part, std::size_t first, std::size_t count) {
    const Placed expected = kernel == Kernel::skinned ? place_skinned_singly(part, first, count)
                                                      : place_rigid_singly(part, first, count);
    const std::int64_t all = hwy::SupportedTargets() & HWY_TARGETS;
    for (std::int64_t rest = all; rest != 0; rest &= rest - 1) {
        for (const Place where : {Place::elsewhere, Place::in_place}) {
            use_target(rest & -rest);
            const Placed placed = place(kernel, part, first, count, where);
            use_target(0);
            INFO(hwy::TargetName(rest & -rest) << (where == Place::in_place ? ", in place" : ""));
            CHECK(same_bits(placed, expected));
        }
    }
}

constexpr Attributes attribute_sets[]{{.normals = true, .tangents = true},
                                      {.normals = true, .tangents = false},
                                      {.normals = false, .tangents = false}};

}  // namespace

TEST_CASE("skinned vertices are placed with the same bits as one by one, for any number of joints",
          "[anim][simd]") {
    const std::uint32_t per_vertex = GENERATE(range(1u, 9u));
    const auto nastiness = GENERATE(Nastiness::none, Nastiness::some, Nastiness::much);
    for (const Attributes& attributes : attribute_sets) {
        const Part part = random_part(per_vertex, nastiness, 200, per_vertex, attributes);
        check(Kernel::skinned, part, 0, 200);
        check(Kernel::skinned, part, 13, 160);
    }
}

TEST_CASE("runs of any length are placed with the same bits as one by one, and nothing beside them",
          "[anim][simd]") {
    const auto kernel = GENERATE(Kernel::skinned, Kernel::rigid);
    for (const Attributes& attributes : attribute_sets) {
        for (std::uint32_t count = 1; count <= 50; ++count) {
            CAPTURE(count);
            const std::size_t first = count % 5;
            check(kernel, random_part(count, Nastiness::some, first + count, 4, attributes), first, count);
        }
    }
}

TEST_CASE("rigid vertices are placed with the same bits as one by one", "[anim][simd]") {
    const std::uint32_t seed = GENERATE(range(1u, 9u));
    const auto nastiness = GENERATE(Nastiness::none, Nastiness::some, Nastiness::much);
    for (const Attributes& attributes : attribute_sets)
        check(Kernel::rigid, random_part(seed, nastiness, 200, 4, attributes), 0, 200);
}

TEST_CASE("normals and tangents are at unit length and never undefined", "[anim][simd]") {
    const auto kernel = GENERATE(Kernel::skinned, Kernel::rigid);
    const std::uint32_t seed = GENERATE(range(1u, 9u));
    const Part part = random_part(seed, Nastiness::much, 500, 4, {});
    const Placed placed = place(kernel, part, 0, 500, Place::elsewhere);
    double worst = 0.0;
    std::size_t undefined = 0;
    const auto look = [&](const glm::vec3& direction) {
        const double error = std::abs(glm::length(glm::dvec3{direction}) - 1.0);
        if (std::isnan(error)) ++undefined;
        worst = std::max(worst, error);
    };
    for (const glm::vec3& normal : placed.normals) look(normal);
    for (const glm::vec4& tangent : placed.tangents) look(glm::vec3{tangent});
    CHECK(undefined == 0);
    CHECK(worst < 1e-6);
}

TEST_CASE("tiny and huge normals keep their direction", "[anim][simd]") {
    const auto kernel = GENERATE(Kernel::skinned, Kernel::rigid);
    const float size = GENERATE(1e-44f, 1e-40f, 1e-20f, 1e20f, 1e38f);
    Part part;
    part.positions.assign(20, glm::vec3{0.0f});
    part.normals.assign(20, glm::vec3{2.0f * size, 0.0f, 2.0f * size});
    part.maps = {{{glm::vec4{1, 0, 0, 0}, glm::vec4{0, 1, 0, 0}, glm::vec4{0, 0, 1, 0}, {}}}};
    part.influences = {.per_vertex = 1,
                       .joints = std::vector<std::uint16_t>(20, 0),
                       .weights = std::vector<float>(20, 1.0f)};
    for (const glm::vec3& normal : place(kernel, part, 0, 20, Place::elsewhere).normals)
        CHECK(glm::distance(normal, glm::vec3{0.70710678f, 0.0f, 0.70710678f}) < 1e-6f);
}

}  // namespace gridreel::anim
