#include "rebuild/reference_kernel.h"

#include "overlap_oracle.h"

#include <catch2/catch.hpp>

#include <glm/common.hpp>

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace gridreel::rebuild {
namespace {

/// Of the slack, less what rounding of cell numbers may take of it: `CellMapping` gives at least twice that.
constexpr double kept_slack = 0.5;

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float uniform() { return float(engine_() >> 8) * 0x1p-24f; }
    glm::vec3 in_cube() {
        const float x = uniform(), y = uniform(), z = uniform();
        return {x, y, z};
    }
    glm::vec3 around(float size) { return (in_cube() - 0.5f) * size; }

private:
    std::mt19937 engine_;
};

struct Kind {
    std::string name;
    Corners (*make)(Random&);
};

/// Most of them in the unit cube.
const std::vector<Kind> kinds{
    {"any",
     [](Random& r) {
         return Corners{r.in_cube(), r.in_cube(), r.in_cube()};
     }},
    {"needle",
     [](Random& r) {
         const glm::vec3 at = r.in_cube();
         return Corners{at, at + r.around(0.005f), r.in_cube()};
     }},
    {"in a plane of the axes",
     [](Random& r) {
         Corners triangle{r.in_cube(), r.in_cube(), r.in_cube()};
         const int axis = int(r.uniform() * 3.0f);
         for (glm::vec3& p : triangle) p[axis] = triangle[0][axis];
         return triangle;
     }},
    {"on planes between cells",
     [](Random& r) {
         Corners triangle{r.in_cube(), r.in_cube(), r.in_cube()};
         for (glm::vec3& p : triangle) p = glm::round(p * 8.0f) / 8.0f;
         return triangle;
     }},
    {"along an axis",
     [](Random& r) {
         Corners triangle{r.in_cube(), r.in_cube(), r.in_cube()};
         const int axis = int(r.uniform() * 3.0f);
         for (glm::vec3& p : triangle) {
             const float along = p[axis];
             p = triangle[0];
             p[axis] = along;
         }
         return triangle;
     }},
    {"steep edge",
     [](Random& r) {
         Corners triangle{r.in_cube(), r.in_cube(), r.in_cube()};
         const int axis = int(r.uniform() * 3.0f);
         triangle[1][axis] = std::nextafter(triangle[0][axis], 2.0f);
         return triangle;
     }},
    {"line",
     [](Random& r) {
         const glm::vec3 a = r.in_cube(), b = r.in_cube();
         return Corners{a, b, glm::mix(a, b, r.uniform())};
     }},
    {"two corners alike",
     [](Random& r) {
         const glm::vec3 a = r.in_cube();
         return Corners{a, r.in_cube(), a};
     }},
    {"far beyond the grid", [](Random& r) {
         return Corners{r.around(300.0f) + 0.5f, r.around(300.0f) + 0.5f, r.around(300.0f) + 0.5f};
     }}};

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;

    [[nodiscard]] TriangleView view() const { return {positions, triangles}; }
    [[nodiscard]] Corners corners(std::size_t i) const {
        return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
    }
};

Soup soup(const Kind& kind, std::uint32_t count, const glm::vec3& at, float scale) {
    Random random(count + static_cast<std::uint32_t>(kind.name.size()));
    Soup result;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const glm::vec3& corner : kind.make(random)) result.positions.push_back(at + scale * corner);
        result.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return result;
}

/// The cells of each triangle, ascending.
std::vector<std::vector<std::uint32_t>> found_cells(const Soup& soup, const CellMapping& mapping) {
    constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
    const std::size_t triangles = soup.triangles.size();
    std::vector<std::uint32_t> cells(ReferenceRoom::padding), owners(triangles);
    const auto find = [&](std::size_t capacity) {
        return find_references(soup.view(), {.count = triangles}, 0, triangles, mapping,
                               {.cells = cells.data(), .triangles = owners.data(), .capacity = capacity},
                               no_limit);
    };
    const std::uint64_t count = find(0);
    cells.resize(count + ReferenceRoom::padding);
    REQUIRE(find(count) == count);
    std::vector<std::vector<std::uint32_t>> found(triangles);
    std::size_t owner = 0;
    for (std::size_t k = 0; k < count; ++k) {
        if ((cells[k] & next_triangle) != 0) ++owner;
        REQUIRE(owner > 0);
        found.at(owners.at(owner - 1)).push_back(cells[k] & ~next_triangle);
    }
    REQUIRE(std::is_sorted(owners.begin(), owners.begin() + std::ptrdiff_t(owner)));
    for (auto& list : found) {
        std::sort(list.begin(), list.end());
        REQUIRE(std::adjacent_find(list.begin(), list.end()) == list.end());
    }
    return found;
}

std::vector<std::uint32_t> cells_of_box(const Corners& triangle, const CellMapping& mapping) {
    std::vector<std::uint32_t> cells;
    for_each_cell(mapping.cells_of(triangle[0], triangle[1], triangle[2]), mapping.resolution(),
                  [&](std::size_t cell) { cells.push_back(static_cast<std::uint32_t>(cell)); });
    return cells;
}

bool holds(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

/// Only the SIMD target with this bit; 0: the best.
void use_target(std::int64_t target) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

TEST_CASE("a triangle is listed wherever some point of it is near, and nowhere beside its box", "[rebuild]") {
    struct Place {
        glm::vec3 at;
        float scale;
    };
    const Place places[] = {{glm::vec3{0.0f}, 1.0f},     {glm::vec3{0.0f}, 1e-3f},
                            {glm::vec3{0.0f}, 1e6f},     {{1e3f, -2e3f, 5e2f}, 1.0f},
                            {{1e6f, 3e6f, -1e6f}, 1e3f}, {glm::vec3{0.0f}, 1e-12f}};
    for (const glm::ivec3 resolution :
         {glm::ivec3{8}, glm::ivec3{1, 20, 3}, glm::ivec3{33, 2, 5}, glm::ivec3{3, 4, 40}}) {
        for (const Place& place : places) {
            const CellMapping mapping({.min = place.at, .max = place.at + place.scale}, resolution);
            for (const Kind& kind : kinds) {
                INFO(kind.name << " at " << place.at.x << ", scale " << place.scale << ", resolution "
                               << resolution.x << " x " << resolution.y << " x " << resolution.z);
                const Soup triangles = soup(kind, 40, place.at, place.scale);
                const auto found = found_cells(triangles, mapping);
                std::size_t missed = 0, beside = 0;
                for (std::size_t i = 0; i < found.size(); ++i) {
                    const Corners triangle = triangles.corners(i);
                    missed += !holds(found[i], cells_near(triangle, mapping, kept_slack));
                    beside += !holds(cells_of_box(triangle, mapping), found[i]);
                }
                CHECK(missed == 0);
                CHECK(beside == 0);
            }
        }
    }
}

TEST_CASE("a needle is listed in little more cells than it passes", "[rebuild]") {
    const CellMapping mapping({.min = glm::vec3{0.0f}, .max = glm::vec3{1.0f}}, glm::ivec3{24});
    const Soup needles = soup(kinds[1], 100, glm::vec3{0.0f}, 1.0f);
    const auto found = found_cells(needles, mapping);
    std::size_t listed = 0, near = 0, in_boxes = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
        listed += found[i].size();
        near += cells_near(needles.corners(i), mapping, 1.0).size();
        in_boxes += cells_of_box(needles.corners(i), mapping).size();
    }
    CHECK(double(listed) < 1.5 * double(near));
    CHECK(listed * 4 < in_boxes);
}

TEST_CASE("triangles that are not traceable or miss the grid are listed nowhere", "[rebuild]") {
    const CellMapping mapping({.min = glm::vec3{0.0f}, .max = glm::vec3{1.0f}}, glm::ivec3{8});
    Soup triangles;
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<Corners> nowhere{{glm::vec3{0.5f}, glm::vec3{infinity}, glm::vec3{0.2f}},
                                       {glm::vec3{0.5f}, glm::vec3{NAN}, glm::vec3{0.2f}},
                                       // Across the corner of the box, beside the grid.
                                       {glm::vec3{-9, 0.5f, 0.5f}, {0.5f, -9, 0.5f}, {0.4f, -9, 0.6f}}};
    for (const Corners& corners : nowhere) {
        const auto first = static_cast<std::uint32_t>(triangles.positions.size());
        triangles.positions.insert(triangles.positions.end(), corners.begin(), corners.end());
        triangles.triangles.emplace_back(first, first + 1, first + 2);
    }
    for (const auto& cells : found_cells(triangles, mapping)) CHECK(cells.empty());
}

TEST_CASE("triangles astronomically larger than a cell are listed in their whole box", "[rebuild]") {
    const CellMapping mapping({.min = glm::vec3{0.0f}, .max = glm::vec3{1e-9f}}, glm::ivec3{8});
    const Soup triangles{.positions = {{-1e11f, 0, 1e-9f}, {1e11f, 1e-9f, 0}, {-1e11f, 1e-9f, 1e-10f}},
                         .triangles = {{0, 1, 2}}};
    CHECK(found_cells(triangles, mapping)[0] == cells_of_box(triangles.corners(0), mapping));
}

TEST_CASE("the same cells are found on every machine", "[rebuild][simd]") {
    const CellMapping mapping({.min = glm::vec3{0.0f}, .max = glm::vec3{1.0f}}, glm::ivec3{21, 60, 34});
    use_target(0);
    const std::int64_t all = hwy::SupportedTargets() & HWY_TARGETS;
    for (const Kind& kind : kinds) {
        const Soup triangles = soup(kind, 300, glm::vec3{0.0f}, 1.0f);
        use_target(0);
        const auto best = found_cells(triangles, mapping);
        for (std::int64_t rest = all; rest != 0; rest &= rest - 1) {
            use_target(rest & -rest);
            INFO(kind.name << ", " << hwy::TargetName(rest & -rest));
            const bool same = found_cells(triangles, mapping) == best;
            use_target(0);
            CHECK(same);
        }
    }
}

TEST_CASE("no more references than the limit are looked for", "[rebuild]") {
    const CellMapping mapping({.min = glm::vec3{0.0f}, .max = glm::vec3{1.0f}}, glm::ivec3{8});
    const Soup triangles = soup(kinds[0], 50, glm::vec3{0.0f}, 1.0f);
    std::uint32_t cells[ReferenceRoom::padding], owners[50];
    const std::uint64_t count = find_references(triangles.view(), {.count = 50}, 0, 50, mapping,
                                                {.cells = cells, .triangles = owners, .capacity = 0}, 100);
    CHECK(count > 100);
    CHECK(count <= 100 + 8 * 8 * 8);
}

}  // namespace gridreel::rebuild
