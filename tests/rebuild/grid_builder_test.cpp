#include "rebuild/grid_builder.h"

#include "overlap_oracle.h"
#include "soup.h"

#include <catch2/catch.hpp>

#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <numeric>
#include <random>
#include <span>
#include <vector>

namespace gridreel::rebuild {
namespace {

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

/// For each cell, triangles that must be listed there, and those that may be.
struct ExpectedLists {
    std::vector<std::vector<std::uint32_t>> least, most;
};

/// The obvious way: a cell lists what comes near it, and nothing whose box does not.
ExpectedLists lists_one_by_one(const Soup& soup, const UniformGrid& grid,
                               const std::vector<std::uint32_t>& least,
                               const std::vector<std::uint32_t>& most) {
    const CellMapping mapping(grid.bounds, grid.resolution, grid.least_slack);
    ExpectedLists lists{.least = std::vector<std::vector<std::uint32_t>>(grid.cell_count()),
                        .most = std::vector<std::vector<std::uint32_t>>(grid.cell_count())};
    for (const std::uint32_t t : most) {
        const glm::uvec3& c = soup.triangles[t];
        const Corners corners{soup.positions[c.x], soup.positions[c.y], soup.positions[c.z]};
        const bool must = std::binary_search(least.begin(), least.end(), t);
        const CellRange range = mapping.cells_of(corners[0], corners[1], corners[2]);
        for_each_cell(range, grid.resolution, [&](std::size_t cell) {
            lists.most[cell].push_back(t);
            const auto x = cell % std::size_t(grid.resolution.x);
            const auto y = cell / std::size_t(grid.resolution.x) % std::size_t(grid.resolution.y);
            const auto z = cell / (std::size_t(grid.resolution.x) * std::size_t(grid.resolution.y));
            const glm::dvec3 low = glm::dvec3{grid.bounds.min} + glm::dvec3{x, y, z} * grid.cell_size;
            constexpr double kept_slack = 0.5;  // less what rounding of cell numbers may take of it
            const glm::dvec3 by = kept_slack * grid.slack;
            if (must && overlaps(corners, low - by, low + grid.cell_size + by))
                lists.least[cell].push_back(t);
        });
    }
    return lists;
}

std::vector<std::uint32_t> numbers_below(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

std::vector<std::uint32_t> copy(const Buffer<std::uint32_t>& buffer) {
    return {buffer.begin(), buffer.end()};
}

/// Everything a grid holds, level by level.
std::vector<std::vector<std::uint32_t>> contents(const Grid& grid) {
    std::vector<std::vector<std::uint32_t>> all;
    for (const GridLevel& level : grid.levels) {
        if (level.grids.empty()) break;
        all.push_back(copy(level.cell_begin));
        all.push_back(copy(level.references));
        for (const UniformGrid& nested : level.grids) {
            const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
            const glm::vec3 &low = nested.bounds.min, &high = nested.bounds.max;
            all.push_back({bits(low.x), bits(low.y), bits(low.z), bits(high.x), bits(high.y), bits(high.z),
                           std::uint32_t(nested.resolution.x), std::uint32_t(nested.resolution.y),
                           std::uint32_t(nested.resolution.z), std::uint32_t(nested.first_cell)});
        }
    }
    return all;
}

void append(Soup& soup, const Soup& more) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), more.positions.begin(), more.positions.end());
    for (const glm::uvec3& t : more.triangles) soup.triangles.push_back(t + first);
}

/// side x side squares in the unit square, two triangles each, which share no vertices.
Soup waving_sheet(int side) {
    Soup sheet;
    for (int i = 0; i < 2 * side * side; ++i) {
        const auto corner = [&](int x, int y) {
            const float u = float(i / 2 % side + x) / float(side), v = float(i / 2 / side + y) / float(side);
            return glm::vec3(u, v, 0.1f * std::sin(9.0f * u) * std::cos(7.0f * v));
        };
        const auto first = static_cast<std::uint32_t>(sheet.positions.size());
        const int upper = i % 2;
        sheet.positions.insert(sheet.positions.end(), {corner(upper, upper), corner(1, 0), corner(0, 1)});
        sheet.triangles.emplace_back(first, first + 1, first + 2);
    }
    return sheet;
}

/// A crowd of small triangles in a corner of a large, coarse scene, half of it a crowd within the crowd.
Soup crowd_in_a_corner(std::uint32_t count) {
    Soup result = soup(200, 0.5f, 3);
    for (glm::vec3& p : result.positions) p *= 100.0f;
    Soup crowd = soup(count, 0.02f, 4);
    for (std::size_t i = 0; i < crowd.positions.size() / 2; ++i) crowd.positions[i] *= 0.02f;
    append(result, crowd);
    return result;
}

/// Checks a grid against lists made one by one, and the grids nested in it against theirs.
/// @return how many grids there were
std::size_t check_grid(const Soup& soup, const Grid& grid, std::size_t depth, std::size_t index,
                       const std::vector<std::uint32_t>& least, const std::vector<std::uint32_t>& most) {
    const GridLevel& level = grid.levels[depth];
    const UniformGrid& at = level.grids[index];
    const ExpectedLists expected = lists_one_by_one(soup, at, least, most);
    std::size_t grids = 1;
    for (std::size_t cell = 0; cell < at.cell_count(); ++cell) {
        const auto &must = expected.least[cell], &may = expected.most[cell];
        const std::uint32_t begin = level.cell_begin[at.first_cell + cell];
        const std::uint32_t end = level.cell_begin[at.first_cell + cell + 1];
        REQUIRE(end - begin >= must.size());
        REQUIRE(end - begin <= may.size());
        if (end == begin) continue;
        if ((level.references[begin] & nested_mark) == 0) {
            const std::vector<std::uint32_t> listed(level.references.begin() + begin,
                                                    level.references.begin() + end);
            REQUIRE(std::is_sorted(listed.begin(), listed.end()));
            REQUIRE(std::includes(listed.begin(), listed.end(), must.begin(), must.end()));
            REQUIRE(std::includes(may.begin(), may.end(), listed.begin(), listed.end()));
            continue;
        }
        REQUIRE(level.references[begin + 1] == end - begin);
        grids += check_grid(soup, grid, depth + 1, level.references[begin] & ~nested_mark, must, may);
    }
    return grids;
}

std::size_t check_grid(const Soup& soup, const Grid& grid) {
    const std::vector<std::uint32_t> all = numbers_below(soup.triangles.size());
    return check_grid(soup, grid, 0, 0, all, all);
}

}  // namespace

TEST_CASE("crowded cells become grids that list what the cell did", "[rebuild]") {
    const Soup triangles = crowd_in_a_corner(2500);
    GridBuilder builder;
    const BuildReport report = builder.rebuild(triangles.view());
    CHECK(report.nested_grids > 1);
    CHECK(check_grid(triangles, builder.grid()) == 1 + report.nested_grids);
    CHECK_FALSE(builder.grid().levels[2].grids.empty());

    GridBuilder flat({.nest_above = 0});
    CHECK(flat.rebuild(triangles.view()).nested_grids == 0);
    CHECK(flat.grid().levels[1].grids.empty());
}

TEST_CASE("crowded cells become grids for any lambda", "[rebuild]") {
    // Smaller cells are worth more references: a small waving sheet in a large box.
    Soup triangles = crowd_in_a_corner(0);
    append(triangles, waving_sheet(80));
    for (const float lambda : {0.25f, 1.0f, 8.0f, 27.0f}) {
        INFO("lambda " << lambda);
        GridBuilder builder({.lambda = lambda});
        CHECK(builder.rebuild(triangles.view()).nested_grids > 0);
        std::uint32_t most = 0;
        for (const auto& level : builder.grid().levels) {
            for (std::size_t cell = 0; cell + 1 < level.cell_begin.size(); ++cell) {
                const std::uint32_t begin = level.cell_begin[cell], end = level.cell_begin[cell + 1];
                const bool nested = begin < end && (level.references[begin] & nested_mark) != 0;
                if (!nested) most = std::max(most, end - begin);
            }
        }
        CHECK(most < 500);
    }
}

TEST_CASE("only cells more crowded than the rest become grids", "[rebuild]") {
    // Of a sheet alone every cell that is not empty holds some ten triangles or more.
    constexpr std::uint32_t nest_above = 8;
    GridBuilder even({.nest_above = nest_above});
    CHECK(even.rebuild(waving_sheet(80).view()).nested_grids == 0);

    for (const float lambda : {0.25f, 1.0f, 2.0f}) {
        INFO("lambda " << lambda);
        GridBuilder builder({.lambda = lambda, .nest_above = nest_above});
        CHECK(builder.rebuild(crowd_in_a_corner(20'000).view()).nested_grids > 0);
        const double times_mean = 16.0 * std::pow(std::min(1.0, double(lambda)), 1.5);
        for (const GridLevel& level : builder.grid().levels) {
            for (const UniformGrid& grid : level.grids.span()) {
                const std::span cells =
                    level.cell_begin.span().subspan(grid.first_cell, grid.cell_count() + 1);
                double occupied = 0.0;
                for (std::size_t c = 0; c < grid.cell_count(); ++c) occupied += cells[c] != cells[c + 1];
                const double references = cells.back() - cells.front();
                for (std::size_t c = 0; c < grid.cell_count(); ++c) {
                    const std::uint32_t size = cells[c + 1] - cells[c];
                    if (size == 0 || (level.references[cells[c]] & nested_mark) == 0) continue;
                    CHECK(size > nest_above);
                    CHECK(size * occupied > 0.999 * times_mean * references);  // but for rounding
                }
            }
        }
    }
}

TEST_CASE("triangles that all lie across each other are not nested", "[rebuild]") {
    Soup triangles = crowd_in_a_corner(10);
    const Soup heap = soup(600, 1.0f, 5);
    append(triangles, heap);
    GridBuilder builder;
    const BuildReport report = builder.rebuild(triangles.view());
    CHECK(report.references <= 8 * triangles.triangles.size());
    CHECK(check_grid(triangles, builder.grid()) == 1 + report.nested_grids);
}

TEST_CASE("every cell lists its triangles in ascending order", "[rebuild]") {
    for (const float size : {0.001f, 0.1f, 0.7f}) {
        const Soup triangles = soup(400, size);
        GridBuilder builder({.lambda = 2.0f});
        builder.rebuild(triangles.view());
        const GridLevel& level = builder.grid().levels[0];
        REQUIRE(level.cell_begin.size() == builder.grid().top().cell_count() + 1);
        REQUIRE(level.cell_begin[0] == 0);
        check_grid(triangles, builder.grid());
    }
}

TEST_CASE("the grid is byte-identical for any number of threads", "[rebuild]") {
    for (const Soup& triangles : {soup(20'000, 0.05f), crowd_in_a_corner(30'000)}) {
        std::vector<std::vector<std::uint32_t>> first;
        for (const int threads : {1, 2, 3, 8}) {
            INFO(threads << " threads");
            GridBuilder builder;
            tbb::task_arena(threads).execute([&] { (void)builder.rebuild(triangles.view()); });
            if (threads == 1) first = contents(builder.grid());
            CHECK(contents(builder.grid()) == first);
        }
    }
}

TEST_CASE("a rebuild forgets the frame before", "[rebuild]") {
    const Soup first = crowd_in_a_corner(20'000), second = soup(700, 0.3f, 2);
    GridBuilder reused, fresh;
    reused.rebuild(first.view());
    reused.rebuild(second.view());
    fresh.rebuild(second.view());
    CHECK(contents(reused.grid()) == contents(fresh.grid()));
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
    CHECK(builder.grid().empty());
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
    CHECK(builder.grid().top().bounds == clean.grid().top().bounds);
    CHECK(*std::max_element(builder.grid().levels[0].references.begin(),
                            builder.grid().levels[0].references.end()) == 49);
}

TEST_CASE("memory that frames have long not needed is let go", "[rebuild]") {
    const Soup triangles = soup(20'000, 0.1f);
    GridBuilder fresh({.lambda = 0.25f}), builder({.lambda = 16.0f});
    const std::size_t needed = fresh.rebuild(triangles.view()).bytes;
    const std::size_t before = builder.rebuild(triangles.view()).bytes;
    CHECK(before > 3 * needed);
    builder.set_lambda(0.25f);
    CHECK(builder.rebuild(triangles.view()).bytes >= before);  // one frame says nothing yet
    std::size_t after = 0;
    for (int frame = 0; frame < 10; ++frame) after = builder.rebuild(triangles.view()).bytes;
    CHECK(after < 2 * needed);
    CHECK(std::ranges::equal(builder.grid().levels[0].references.span(),
                             fresh.grid().levels[0].references.span()));
    CHECK(builder.rebuild(triangles.view()).bytes == after);  // and that is that
}

TEST_CASE("vertices that no triangle uses do not stretch the box", "[rebuild]") {
    Soup triangles = soup(50, 0.1f);
    GridBuilder clean, builder;
    clean.rebuild(triangles.view());
    triangles.positions.emplace_back(1e6f);
    builder.rebuild(triangles.view());
    CHECK(builder.grid().top().bounds == clean.grid().top().bounds);
}

// Sanitizers end the program where memory runs out, instead of letting `new` throw.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a buffer that cannot grow is empty, not wrong", "[rebuild]") {
    Buffer<std::uint64_t> buffer;
    buffer.resize(100);
    CHECK_THROWS_AS(buffer.resize(std::size_t{1} << 58), std::bad_alloc);
    CHECK(buffer.size() == 0);
    buffer.resize(1000);
    buffer[999] = 7;
    CHECK(buffer[999] == 7);
}
#endif

TEST_CASE("triangles as large as the scene make the grid coarser, not endless", "[rebuild]") {
    const Soup triangles = soup(20'000, 50.0f);  // each box covers most of the scene
    std::vector<std::uint32_t> references;
    for (const int threads : {1, 3}) {
        GridBuilder builder({.lambda = 5.0f});
        BuildReport report;
        tbb::task_arena(threads).execute([&] { report = builder.rebuild(triangles.view()); });
        CHECK(report.references <= 64 * triangles.triangles.size());
        CHECK(report.references >= triangles.triangles.size());
        if (threads == 1) references = copy(builder.grid().levels[0].references);
        CHECK(copy(builder.grid().levels[0].references) == references);
    }
}

TEST_CASE("flat, tiny, huge and far scenes get cells of some size", "[rebuild]") {
    for (const float scale : {1e-10f, 1.0f, 1e8f}) {
        for (const float far : {0.0f, 1e3f}) {
            Soup triangles = soup(300, 0.1f);
            for (glm::vec3& p : triangles.positions) p = (glm::vec3{p.x, 0.5f, p.z} + far) * scale;
            GridBuilder builder;
            const BuildReport report = builder.rebuild(triangles.view());
            const glm::dvec3 size = builder.grid().top().cell_size;
            CHECK((size.x > 0.0 && size.y > 0.0 && size.z > 0.0));
            CHECK(report.references >= 300);
            for (const glm::vec3& p : triangles.positions) {
                const Bounds3& box = builder.grid().top().bounds;
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
