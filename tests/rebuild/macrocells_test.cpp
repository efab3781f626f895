#include "rebuild/macrocells.h"

#include "rebuild/grid_builder.h"
#include "soup.h"

#include <catch2/catch.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace gridreel::rebuild {
namespace {

class Random {
public:
    float uniform(float high) { return high * float(random_() >> 8) * 0x1p-24f; }
    int below(int count) { return static_cast<int>(random_() % static_cast<std::uint32_t>(count)); }
    glm::vec3 in_box(const glm::vec3& size) {
        const float x = uniform(size.x), y = uniform(size.y), z = uniform(size.z);
        return {x, y, z};
    }

private:
    std::mt19937 random_{5};
};

/// Triangles no larger than `size` somewhere in `box`.
void add_soup(Soup& soup, int count, const glm::vec3& low, const glm::vec3& box, float size) {
    Random random;
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size());
        const glm::vec3 at = low + random.in_box(box);
        for (int corner = 0; corner < 3; ++corner)
            soup.positions.push_back(at + random.in_box(glm::min(box, glm::vec3(size))));
        soup.triangles.emplace_back(first, first + 1, first + 2);
    }
}

/// Two heaps in opposite corners, and nothing between them.
Soup two_heaps(int count) {
    Soup soup;
    add_soup(soup, count, glm::vec3(0.0f), glm::vec3(1.0f), 0.2f);
    add_soup(soup, count, glm::vec3(8.0f, 11.0f, 9.0f), glm::vec3(1.0f), 0.2f);
    return soup;
}

/// Whether each cell of the top grid lists anything.
std::vector<bool> cells_in_use(const Grid& grid) {
    std::vector<bool> used(grid.top().cell_count());
    const Buffer<std::uint32_t>& begin = grid.levels[0].cell_begin;
    for (std::size_t c = 0; c < used.size(); ++c)
        used[c] = begin[grid.top().first_cell + c] < begin[grid.top().first_cell + c + 1];
    return used;
}

/// The obvious way: looks at every cell of every cube that [first, last] touches.
bool any_one_by_one(const Grid& grid, const std::vector<bool>& used, const glm::ivec3& first,
                    const glm::ivec3& last) {
    const glm::ivec3 cells = grid.top().resolution;
    const glm::ivec3 begin = first / Macrocells::side * Macrocells::side;
    const glm::ivec3 end = glm::min((last / Macrocells::side + 1) * Macrocells::side, cells);
    for (int z = begin.z; z < end.z; ++z) {
        for (int y = begin.y; y < end.y; ++y) {
            for (int x = begin.x; x < end.x; ++x) {
                const int cell = (z * cells.y + y) * cells.x + x;
                if (used[static_cast<std::size_t>(cell)]) return true;
            }
        }
    }
    return false;
}

/// Every cube, and boxes of cells at random.
/// @return how many cubes are empty
int check_macrocells(const Grid& grid, const Macrocells& macrocells) {
    const std::vector<bool> used = cells_in_use(grid);
    const glm::ivec3 cells = grid.top().resolution;
    int wrong = 0, empty = 0;
    const auto check = [&](const glm::ivec3& first, const glm::ivec3& last) {
        const bool expected = any_one_by_one(grid, used, first, last);
        wrong += macrocells.any_in(first, last) != expected;
        return expected;
    };
    for (int z = 0; z < cells.z; z += Macrocells::side) {
        for (int y = 0; y < cells.y; y += Macrocells::side) {
            for (int x = 0; x < cells.x; x += Macrocells::side) {
                const glm::ivec3 first{x, y, z};
                const glm::ivec3 last = glm::min(first + (Macrocells::side - 1), cells - 1);
                empty += check(first, first) ? 0 : 1;
                check(last, last);
            }
        }
    }
    Random random;
    for (int i = 0; i < 200; ++i) {
        const glm::ivec3 a{random.below(cells.x), random.below(cells.y), random.below(cells.z)};
        const glm::ivec3 b{random.below(cells.x), random.below(cells.y), random.below(cells.z)};
        check(glm::min(a, b), glm::min(glm::max(a, b), glm::min(a, b) + 7));
    }
    CHECK(wrong == 0);
    return empty;
}

}  // namespace

TEST_CASE("a macrocell is occupied if any of its cells is", "[rebuild]") {
    for (const float lambda : {0.3f, 1.0f, 5.0f}) {
        INFO("lambda " << lambda);
        GridBuilder builder({.lambda = lambda});
        Macrocells macrocells;
        const auto empty_of = [&](const Soup& soup) {
            builder.rebuild(soup.view());
            macrocells.rebuild(builder.grid());
            return check_macrocells(builder.grid(), macrocells);
        };
        // Scenes in turns through the same memory: nothing of the frame before is left.
        CHECK(empty_of(two_heaps(3000)) > 0);
        Soup dense;
        add_soup(dense, 2000, glm::vec3(0.0f), glm::vec3(1.0f), 0.3f);
        CHECK(empty_of(dense) == 0);
        Soup flat;
        add_soup(flat, 900, glm::vec3(0.0f), glm::vec3(1.0f, 1.0f, 0.0f), 0.05f);
        add_soup(flat, 900, glm::vec3(4.0f, 6.0f, 0.0f), glm::vec3(1.0f, 1.0f, 0.0f), 0.05f);
        CHECK(empty_of(flat) > 0);
        CHECK(builder.grid().top().resolution.z == 1);
        CHECK(empty_of(two_heaps(3000)) > 0);
    }
}

TEST_CASE("macrocells of one cell, and of none", "[rebuild]") {
    Soup one;
    add_soup(one, 1, glm::vec3(0.0f), glm::vec3(1.0f), 0.5f);
    GridBuilder builder({.lambda = 0.01f});
    builder.rebuild(one.view());
    REQUIRE(builder.grid().top().cell_count() == 1);
    Macrocells macrocells;
    macrocells.rebuild(builder.grid());
    CHECK(check_macrocells(builder.grid(), macrocells) == 0);

    builder.rebuild({});
    REQUIRE(builder.grid().empty());
    macrocells.rebuild(builder.grid());  // has nothing to look at
    builder.rebuild(one.view());
    macrocells.rebuild(builder.grid());
    CHECK(check_macrocells(builder.grid(), macrocells) == 0);
}

TEST_CASE("cells that became grids occupy their macrocells", "[rebuild]") {
    Soup soup;
    add_soup(soup, 60, glm::vec3(0.0f), glm::vec3(100.0f), 0.5f);
    add_soup(soup, 4000, glm::vec3(70.0f), glm::vec3(1.0f), 0.05f);
    GridBuilder builder;
    REQUIRE(builder.rebuild(soup.view()).nested_grids > 0);
    Macrocells macrocells;
    macrocells.rebuild(builder.grid());
    CHECK(check_macrocells(builder.grid(), macrocells) > 0);
}

TEST_CASE("macrocells do not depend on the number of threads", "[rebuild]") {
    const Soup soup = two_heaps(5000);
    for (const int threads : {1, 3}) {
        INFO(threads << " threads");
        GridBuilder builder({.lambda = 5.0f});
        Macrocells macrocells;
        tbb::task_arena(threads).execute([&] {
            builder.rebuild(soup.view());
            macrocells.rebuild(builder.grid());
        });
        CHECK(check_macrocells(builder.grid(), macrocells) > 0);
    }
}

}  // namespace gridreel::rebuild
