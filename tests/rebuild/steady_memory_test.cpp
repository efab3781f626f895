// Frames alike need no new memory, however much of it was asked for in vain.

#include "rebuild/grid_builder.h"

#include "soup.h"
#include "tests/rebuild/grid_contents.h"

#include <catch2/catch.hpp>

#include <tbb/task_arena.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <random>
#include <vector>

namespace {

/// Calls of the operator that `rebuild::Buffer` allocates with.
std::atomic<std::size_t> allocations = 0;

/// The first of them that finds no memory.
std::atomic<std::size_t> first_to_fail = std::numeric_limits<std::size_t>::max();

}  // namespace

void* operator new[](std::size_t bytes, std::align_val_t alignment) {
    if (++allocations >= first_to_fail) throw std::bad_alloc();
    const auto unit = static_cast<std::size_t>(alignment);
    void* const memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void operator delete[](void* memory, std::align_val_t) noexcept {
    std::free(memory);
}

namespace gridreel::rebuild {
namespace {

/// Triangles of up to `size` metres in the unit cube, the last half of them in a thousandth of it.
Soup half_crowded(std::uint32_t count, float size) {
    std::mt19937 random(7);
    const auto in_cube = [&] {
        const auto uniform = [&] { return float(random() >> 8) * 0x1p-24f; };
        const float x = uniform(), y = uniform(), z = uniform();
        return glm::vec3{x, y, z};
    };
    Soup result;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float scale = i < count / 2 ? 1.0f : 0.1f;
        const glm::vec3 at = in_cube();
        for (int corner = 0; corner < 3; ++corner) {
            result.positions.push_back(scale * (at + size * in_cube()));
        }
        result.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return result;
}

}  // namespace

TEST_CASE("frames alike need no new memory", "[rebuild]") {
    // Small and large triangles; large ones at many cells each make the grid coarser in several tries.
    for (const float size : {0.01f, 0.3f, 30.0f}) {
        for (const float lambda : {0.01f, 1.0f, 100.0f, 2000.0f}) {
            for (const int threads : {1, 4}) {
                INFO("size " << size << ", lambda " << lambda << ", " << threads << " threads");
                const Soup triangles = half_crowded(1'000, size);
                GridBuilder builder({.lambda = lambda});
                tbb::task_arena arena(threads);
                const auto frame = [&] { (void)builder.rebuild(triangles.view()); };
                arena.execute(frame);
                const std::size_t before = allocations;
                for (int i = 0; i < 20; ++i) arena.execute(frame);
                CHECK(allocations == before);
            }
        }
    }
}

TEST_CASE("levels that a frame has no grids on are empty", "[rebuild]") {
    GridBuilder builder;
    const Soup crowded = half_crowded(20'000, 0.001f);
    REQUIRE(builder.rebuild(crowded.view()).nested_grids > 0);
    const Soup even = half_crowded(20, 0.001f);
    REQUIRE(builder.rebuild(even.view()).nested_grids == 0);
    for (std::size_t depth = 1; depth <= deepest_nesting; ++depth) {
        CHECK(builder.grid().levels[depth].grids.empty());
        CHECK(builder.grid().levels[depth].cell_begin.empty());
        CHECK(builder.grid().levels[depth].references.empty());
    }
}

TEST_CASE("nothing is taken over from a frame that found no memory", "[rebuild]") {
    // All stand still but the last triangle, which flies far off in the frame that fails.
    Soup soup = half_crowded(4'000, 0.01f);
    const std::size_t still = soup.triangles.size() - 1;
    TriangleView view = soup.view();
    view.still = std::make_shared<StillTriangles>(still + 1, std::vector<TriangleRun>{{0, still}});
    const auto place = [&](float z) {
        for (std::size_t i = 3 * still; i < soup.positions.size(); ++i) soup.positions[i].z = z;
    };
    place(0.5f);
    GridBuilder fresh;
    REQUIRE(fresh.rebuild(soup.view()).nested_grids > 0);

    bool failed = true;
    std::size_t failures = 0;
    for (std::size_t lucky = 0; failed; ++lucky) {
        GridBuilder builder;
        place(0.5f);
        (void)builder.rebuild(view);
        place(2.0f);
        (void)builder.rebuild(view);
        place(30.0f);
        builder.set_lambda(4.0f);
        first_to_fail = allocations + lucky + 1;
        failed = false;
        try {
            (void)builder.rebuild(view);
        } catch (const std::bad_alloc&) {
            failed = true;
            ++failures;
        }
        first_to_fail = std::numeric_limits<std::size_t>::max();

        for (const float z : {30.0f, 2.0f, 30.0f}) {
            place(z);
            const BuildReport report = builder.rebuild(view);
            GridBuilder other;
            other.set_lambda(4.0f);
            CHECK(report.cells == other.rebuild(soup.view()).cells);
            REQUIRE(test::grid_contents(builder.grid()) == test::grid_contents(other.grid()));
        }
    }
    CHECK(failures > 0);
}

}  // namespace gridreel::rebuild
