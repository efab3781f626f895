#include "rebuild/grid_builder.h"

#include <catch2/catch.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <random>
#include <vector>

namespace gridreel::rebuild {
namespace {

struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    [[nodiscard]] TriangleView view() const { return {positions, triangles}; }
};

Soup soup(std::uint32_t count, float size, std::uint32_t seed = 1) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return float(random() >> 8) * 0x1p-24f; };
    const auto in_cube = [&] {
        const float x = uniform(), y = uniform(), z = uniform();
        return glm::vec3{x, y, z};
    };
    Soup result;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 at = in_cube();
        for (int corner = 0; corner < 3; ++corner) result.positions.push_back(at + size * in_cube());
        result.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return result;
}

/// The obvious way: for each cell, every triangle whose box comes near it.
std::vector<std::vector<std::uint32_t>> lists_one_by_one(const Soup& soup, const Grid& grid) {
    const CellMapping mapping(grid.bounds, grid.resolution);
    std::vector<std::vector<std::uint32_t>> lists(grid.cell_count());
    for (std::size_t cell = 0; cell < lists.size(); ++cell) {
        const auto x = cell % std::size_t(grid.resolution.x);
        const auto y = cell / std::size_t(grid.resolution.x) % std::size_t(grid.resolution.y);
        const auto z = cell / (std::size_t(grid.resolution.x) * std::size_t(grid.resolution.y));
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            const glm::uvec3& c = soup.triangles[t];
            const CellRange range =
                mapping.cells_of(soup.positions[c.x], soup.positions[c.y], soup.positions[c.z]);
            const bool within = range.first[0] <= x && x <= range.last[0] && range.first[1] <= y &&
                                y <= range.last[1] && range.first[2] <= z && z <= range.last[2];
            if (within) lists[cell].push_back(t);
        }
    }
    return lists;
}

std::vector<std::uint32_t> copy(const Buffer<std::uint32_t>& buffer) {
    return {buffer.begin(), buffer.end()};
}

}  // namespace

TEST_CASE("every cell lists its triangles in ascending order", "[rebuild]") {
    for (const float size : {0.001f, 0.1f, 0.7f}) {
        const Soup triangles = soup(400, size);
        GridBuilder builder({.lambda = 2.0f});
        builder.rebuild(triangles.view());
        const Grid& grid = builder.grid();
        const auto expected = lists_one_by_one(triangles, grid);
        REQUIRE(grid.cell_begin.size() == expected.size() + 1);
        REQUIRE(grid.cell_begin[0] == 0);
        for (std::size_t cell = 0; cell < expected.size(); ++cell) {
            const std::vector<std::uint32_t> list(grid.references.begin() + grid.cell_begin[cell],
                                                  grid.references.begin() + grid.cell_begin[cell + 1]);
            REQUIRE(list == expected[cell]);
        }
    }
}

TEST_CASE("the grid is byte-identical for any number of threads", "[rebuild]") {
    const Soup triangles = soup(20'000, 0.05f);
    std::vector<std::uint32_t> begin, references;
    for (const int threads : {1, 2, 3, 8}) {
        INFO(threads << " threads");
        GridBuilder builder;
        BuildReport report;
        tbb::task_arena(threads).execute([&] { report = builder.rebuild(triangles.view()); });
        if (threads == 1) {
            begin = copy(builder.grid().cell_begin);
            references = copy(builder.grid().references);
        }
        CHECK(copy(builder.grid().cell_begin) == begin);
        CHECK(copy(builder.grid().references) == references);
        CHECK(report.references == references.size());
        CHECK(report.cells + 1 == begin.size());
    }
}

TEST_CASE("a rebuild forgets the frame before", "[rebuild]") {
    const Soup first = soup(5000, 0.1f, 1), second = soup(700, 0.3f, 2);
    GridBuilder reused, fresh;
    reused.rebuild(first.view());
    reused.rebuild(second.view());
    fresh.rebuild(second.view());
    CHECK(copy(reused.grid().cell_begin) == copy(fresh.grid().cell_begin));
    CHECK(copy(reused.grid().references) == copy(fresh.grid().references));
    CHECK(reused.grid().bounds == fresh.grid().bounds);
}

TEST_CASE("memory is kept from frame to frame", "[rebuild]") {
    GridBuilder builder;
    const std::size_t bytes = builder.rebuild(soup(5000, 0.1f, 1).view()).bytes;
    CHECK(bytes > 0);
    CHECK(builder.rebuild(soup(4000, 0.1f, 2).view()).bytes == bytes);
    CHECK(builder.rebuild(soup(5000, 0.1f, 1).view()).bytes == bytes);
}

TEST_CASE("no triangles make an empty grid", "[rebuild]") {
    GridBuilder builder;
    builder.rebuild(soup(10, 0.1f).view());
    const BuildReport report = builder.rebuild({});
    CHECK(report.cells == 0);
    CHECK(builder.grid().cell_count() == 0);
    CHECK(builder.grid().bounds.empty());
}

TEST_CASE("triangles that cannot be traced are in no cell and do not stretch the box", "[rebuild]") {
    Soup triangles = soup(50, 0.1f);
    GridBuilder clean;
    clean.rebuild(triangles.view());
    const auto good = static_cast<std::uint32_t>(triangles.positions.size());
    triangles.positions.emplace_back(std::numeric_limits<float>::quiet_NaN());
    triangles.positions.emplace_back(std::numeric_limits<float>::infinity());
    triangles.positions.emplace_back(1e30f);
    triangles.triangles.emplace_back(0, 1, good);
    triangles.triangles.emplace_back(0, good + 1, 2);
    triangles.triangles.emplace_back(good + 2, 1, 2);
    GridBuilder builder;
    builder.rebuild(triangles.view());
    CHECK(builder.grid().bounds == clean.grid().bounds);
    CHECK(*std::max_element(builder.grid().references.begin(), builder.grid().references.end()) == 49);
}

TEST_CASE("vertices that no triangle uses do not stretch the box", "[rebuild]") {
    Soup triangles = soup(50, 0.1f);
    GridBuilder clean, builder;
    clean.rebuild(triangles.view());
    triangles.positions.emplace_back(1e6f);
    builder.rebuild(triangles.view());
    CHECK(builder.grid().bounds == clean.grid().bounds);
}

TEST_CASE("a buffer that cannot grow is empty, not wrong", "[rebuild]") {
    Buffer<std::uint64_t> buffer;
    buffer.resize(100);
    CHECK_THROWS_AS(buffer.resize(std::size_t{1} << 58), std::bad_alloc);
    CHECK(buffer.size() == 0);
    buffer.resize(1000);
    buffer[999] = 7;
    CHECK(buffer[999] == 7);
}

TEST_CASE("triangles as large as the scene make the grid coarser, not endless", "[rebuild]") {
    const Soup triangles = soup(20'000, 50.0f);  // each box covers most of the scene
    std::vector<std::uint32_t> references;
    for (const int threads : {1, 3}) {
        GridBuilder builder({.lambda = 5.0f});
        BuildReport report;
        tbb::task_arena(threads).execute([&] { report = builder.rebuild(triangles.view()); });
        CHECK(report.references <= 64 * triangles.triangles.size());
        CHECK(report.references >= triangles.triangles.size());
        if (threads == 1) references = copy(builder.grid().references);
        CHECK(copy(builder.grid().references) == references);
    }
}

TEST_CASE("flat, tiny, huge and far scenes get cells of some size", "[rebuild]") {
    for (const float scale : {1e-10f, 1.0f, 1e8f}) {
        for (const float far : {0.0f, 1e3f}) {
            Soup triangles = soup(300, 0.1f);
            for (glm::vec3& p : triangles.positions) p = (glm::vec3{p.x, 0.5f, p.z} + far) * scale;
            GridBuilder builder;
            const BuildReport report = builder.rebuild(triangles.view());
            const glm::dvec3 size = builder.grid().cell_size;
            CHECK((size.x > 0.0 && size.y > 0.0 && size.z > 0.0));
            CHECK(report.references >= 300);
            for (const glm::vec3& p : triangles.positions) {
                const Bounds3& box = builder.grid().bounds;
                CHECK((box.min.x < p.x && box.min.y < p.y && box.min.z < p.z && p.x < box.max.x &&
                       p.y < box.max.y && p.z < box.max.z));
            }
        }
    }
}

TEST_CASE("a bad policy is refused before the first frame", "[rebuild]") {
    CHECK_THROWS_AS(GridBuilder({.lambda = -1.0f}), std::invalid_argument);
}

}  // namespace gridreel::rebuild
