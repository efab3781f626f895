// What is taken over from the last frame changes nothing: grids are those of a builder that never saw
// another.

#include "rebuild/still_triangles.h"

#include "rebuild/grid_builder.h"
#include "soup.h"
#include "tests/rebuild/grid_contents.h"

#include <catch2/catch.hpp>

#include <tbb/task_arena.h>

#include <cstdint>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gridreel::rebuild {
namespace {

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float uniform() { return float(engine_() >> 8) * 0x1p-24f; }
    std::uint32_t below(std::uint32_t count) { return std::uint32_t(engine_() % count); }
    glm::vec3 in_cube() {
        const float x = uniform(), y = uniform(), z = uniform();
        return {x, y, z};
    }

private:
    std::mt19937 engine_;
};

/// Some parts stand still, others fly about; one of each kind is a crowd, which becomes nested grids.
class Animation {
    static constexpr float lower_corner = -4.0f, upper_corner = 5.0f;

public:
    /// @param moving_share  of the parts
    /// @param stretch       of all triangles
    Animation(std::uint32_t seed, float moving_share, std::uint32_t triangles_per_part = 900,
              float stretch = 1.0f)
        : random_(seed) {
        constexpr int parts = 12;
        std::vector<TriangleRun> still_runs;
        for (int part = 0; part < parts; ++part) {
            const bool moves = float(part % parts) < moving_share * parts;
            // In turns, so that lists of still and moving triangles are to be merged.
            const std::size_t first = soup_.triangles.size();
            const float size = part % 3 == 0 ? 0.02f : 1.0f,
                        length = stretch * (part % 4 == 1 ? 0.5f : 0.03f);
            add_part(triangles_per_part / (1 + random_.below(3)), size, length);
            if (part % 2 == 0) add_part(1, 1.0f, 0.1f);
            const std::size_t end = soup_.triangles.size();
            if (moves) {
                moving_.push_back({first, end});
            } else if (end > first) {
                still_runs.push_back({first, end});
            }
        }
        // The corners of the scene stand still, and so does its box as long as parts stay within.
        for (const float corner : {lower_corner, upper_corner}) {
            const auto first = static_cast<std::uint32_t>(soup_.positions.size());
            soup_.positions.insert(soup_.positions.end(), 3, glm::vec3{corner});
            still_runs.push_back({soup_.triangles.size(), soup_.triangles.size() + 1});
            soup_.triangles.emplace_back(first, first + 1, first + 2);
        }
        rest_ = soup_.positions;
        still_ = std::make_shared<StillTriangles>(soup_.triangles.size(), still_runs);
    }

    /// @param reach  how far parts move: within the scene's box, or beyond it
    void next_frame(float reach) {
        for (const TriangleRun& run : moving_) {
            const glm::vec3 by = reach * (random_.in_cube() - 0.5f);
            for (std::size_t i = 3 * run.begin; i < 3 * run.end; ++i) soup_.positions[i] = rest_[i] + by;
        }
    }

    /// Two more triangles, which move: the corners of a larger box.
    void add_outriders() {
        const auto first = static_cast<std::uint32_t>(soup_.positions.size());
        soup_.positions.resize(first + 2);
        soup_.triangles.emplace_back(first, first, first);
        soup_.triangles.emplace_back(first + 1, first + 1, first + 1);
        const auto runs = still_->runs();
        still_ = std::make_shared<StillTriangles>(soup_.triangles.size(),
                                                  std::vector<TriangleRun>(runs.begin(), runs.end()));
    }
    void place_outriders(float low, float high) {
        soup_.positions[soup_.positions.size() - 2] = glm::vec3{low};
        soup_.positions[soup_.positions.size() - 1] = glm::vec3{high};
    }

    void shift(float by) {
        for (glm::vec3& p : soup_.positions) p += by;
    }

    /// In the same box.
    void mirror() {
        for (glm::vec3& p : soup_.positions) p = lower_corner + upper_corner - p;
    }

    [[nodiscard]] TriangleView view() const {
        return {.positions = soup_.positions, .triangles = soup_.triangles, .still = still_};
    }
    [[nodiscard]] TriangleView silent_view() const { return soup_.view(); }

private:
    /// Three corners of its own for each triangle.
    void add_part(std::uint32_t count, float size, float length) {
        const glm::vec3 at = random_.in_cube();
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto first = static_cast<std::uint32_t>(soup_.positions.size());
            const glm::vec3 corner = at + size * random_.in_cube();
            for (int k = 0; k < 3; ++k) soup_.positions.push_back(corner + length * size * random_.in_cube());
            soup_.triangles.emplace_back(first, first + 1, first + 2);
        }
    }

    Random random_;
    Soup soup_;
    std::vector<glm::vec3> rest_;
    std::vector<TriangleRun> moving_;
    std::shared_ptr<const StillTriangles> still_;
};

/// @return whether a builder that knows only this frame makes the same
bool as_from_scratch(const GridBuilder& builder, const BuildReport& report, TriangleView view,
                     const ResolutionPolicy& policy) {
    GridBuilder fresh(policy);
    view.still = nullptr;
    const BuildReport expected = fresh.rebuild(view);
    return test::grid_contents(builder.grid()) == test::grid_contents(fresh.grid()) &&
           report.cells == expected.cells && report.references == expected.references &&
           report.nested_grids == expected.nested_grids;
}

}  // namespace

TEST_CASE("grids do not depend on what is known to stand still", "[rebuild]") {
    for (const float share : {0.0f, 0.1f, 0.4f, 0.8f, 1.0f}) {
        for (const int threads : {1, 2, 5}) {
            INFO(share << " of the parts move, " << threads << " threads");
            Animation animation(static_cast<std::uint32_t>(100.0f * share) + 1, share);
            ResolutionPolicy policy{.nest_above = 40};
            GridBuilder builder(policy);
            Random random(9);
            std::uint64_t nested = 0;
            for (int frame = 0; frame < 24; ++frame) {
                // Frames alike, boxes that stay and boxes that do not, another lambda now and then.
                if (frame % 5 != 4)
                    animation.next_frame(frame % 8 == 6 ? 20.0f : frame % 2 == 0 ? 1.0f : 0.05f);
                if (frame % 7 == 6) {
                    policy.lambda = std::vector{0.125f, 1.0f, 4.0f}[random.below(3)];
                    builder.set_lambda(policy.lambda);
                }
                BuildReport report;
                tbb::task_arena(threads).execute([&] { report = builder.rebuild(animation.view()); });
                INFO("frame " << frame << ", lambda " << policy.lambda);
                REQUIRE(as_from_scratch(builder, report, animation.view(), policy));
                nested += report.nested_grids;
            }
            CHECK(nested > 0);
        }
    }
}

TEST_CASE("large animations that stand still in part are put together from many pieces", "[rebuild]") {
    Animation animation(3, 0.3f, 20'000);
    const ResolutionPolicy policy{.lambda = 0.5f};
    GridBuilder builder(policy);
    for (int frame = 0; frame < 5; ++frame) {
        animation.next_frame(0.05f);
        BuildReport report;
        tbb::task_arena(4).execute([&] { report = builder.rebuild(animation.view()); });
        REQUIRE(as_from_scratch(builder, report, animation.view(), policy));
    }
}

TEST_CASE("triangles across too many cells are taken over from the coarser grid they made", "[rebuild]") {
    // More than 64 references a triangle: the first tries are given up.
    Animation animation(4, 0.2f, 300, 40.0f);
    const ResolutionPolicy policy{.lambda = 2'000.0f, .nest_above = 20};
    GridBuilder builder(policy);
    for (int frame = 0; frame < 4; ++frame) {
        if (frame % 2 == 0) animation.next_frame(0.01f);  // else in the same box
        const BuildReport report = builder.rebuild(animation.view());
        REQUIRE(as_from_scratch(builder, report, animation.view(), policy));
        CHECK(double(report.cells) < 0.5 * double(policy.lambda) * double(animation.view().size()));
    }
}

TEST_CASE("nothing is taken over from another animation of the same size", "[rebuild]") {
    GridBuilder builder;
    for (int turn = 0; turn < 3; ++turn) {
        for (const int kind : {0, 1, 2}) {
            // Made anew: of the same size, often at the same place in memory, and the first two in the same
            // box.
            const auto animation = std::make_unique<Animation>(5, 0.4f);
            if (kind == 1) animation->mirror();
            if (kind == 2) animation->shift(3.0f);
            const BuildReport report = builder.rebuild(animation->view());
            REQUIRE(as_from_scratch(builder, report, animation->view(), {}));
        }
    }
}

TEST_CASE("frames of whoever says nothing, and frames without triangles, may come between", "[rebuild]") {
    Animation animation(7, 0.2f), other(8, 0.3f);
    GridBuilder builder({.nest_above = 40});
    const ResolutionPolicy policy{.nest_above = 40};
    const auto check = [&](const TriangleView& view) {
        const BuildReport report = builder.rebuild(view);
        REQUIRE(as_from_scratch(builder, report, view, policy));
    };
    for (int frame = 0; frame < 6; ++frame) {
        animation.next_frame(0.05f);
        check(animation.view());
        if (frame == 1) check(other.silent_view());
        if (frame == 3) REQUIRE(builder.rebuild({}).cells == 0);
        if (frame == 4) check(other.view());
    }
}

TEST_CASE("another lambda makes other nested grids in the same top grid", "[rebuild]") {
    const Animation animation(11, 0.0f);
    ResolutionPolicy policy{.lambda = 0.1f, .nest_above = 20};
    GridBuilder builder(policy);
    BuildReport last = builder.rebuild(animation.view());
    int other_nested = 0;
    for (int frame = 0; frame < 40; ++frame) {
        policy.lambda *= 1.003f;
        builder.set_lambda(policy.lambda);
        const BuildReport report = builder.rebuild(animation.view());
        other_nested += report.resolution == last.resolution && report.cells != last.cells;
        last = report;
        REQUIRE(as_from_scratch(builder, report, animation.view(), policy));
    }
    CHECK(other_nested > 0);
}

TEST_CASE("a box that shifts moves the cells of still triangles, though they are as many and as large",
          "[rebuild]") {
    const ResolutionPolicy policy{.lambda = 0.1f, .nest_above = 20};
    Animation animation(12, 0.0f);
    animation.add_outriders();
    GridBuilder builder(policy);
    // Along the diagonal in binary fractions, which are not rounded; then at its upper end alone, by so
    // little that it rounds away where the box is padded, but not from its size.
    std::vector<std::pair<float, float>> boxes;
    for (int i = 0; i < 10; ++i) boxes.emplace_back(-5.0f + float(i) * 0x1p-8f, 6.0f + float(i) * 0x1p-8f);
    for (int i = 0; i < 10; ++i) boxes.emplace_back(-4.0f, 8.0f - float(i) * 0x1p-21f);
    glm::ivec3 last{0};
    int same_resolution = 0;
    for (const auto& [low, high] : boxes) {
        animation.place_outriders(low, high);
        const BuildReport report = builder.rebuild(animation.view());
        REQUIRE(report.nested_grids > 0);
        same_resolution += report.resolution == last;
        last = report.resolution;
        REQUIRE(as_from_scratch(builder, report, animation.view(), policy));
    }
    CHECK(same_resolution > 10);
}

TEST_CASE("what is remembered takes little memory", "[rebuild]") {
    for (const float lambda : {1.0f, 0.1f}) {  // few nested grids, and many
        for (const int threads : {1, 2, 5}) {
            INFO("lambda " << lambda << ", " << threads << " threads");
            Animation animation(10, 0.2f, 20'000);
            GridBuilder silent({.lambda = lambda}), builder({.lambda = lambda});
            tbb::task_arena arena(threads);
            arena.execute([&] {
                const BuildReport expected = silent.rebuild(animation.silent_view());
                for (int frame = 0; frame < 20; ++frame) {
                    animation.next_frame(0.01f);
                    CHECK(builder.rebuild(animation.view()).bytes < expected.bytes + expected.bytes / 10);
                }
            });
        }
    }
}

TEST_CASE("runs of still triangles are checked", "[rebuild]") {
    using Runs = std::vector<TriangleRun>;
    CHECK_THROWS_AS(StillTriangles(5, Runs{{0, 6}}), std::invalid_argument);
    CHECK_THROWS_AS(StillTriangles(5, Runs{{2, 1}}), std::invalid_argument);
    CHECK_THROWS_AS(StillTriangles(5, Runs{{2, 4}, {3, 5}}), std::invalid_argument);

    const StillTriangles still(5, Runs{{0, 1}, {2, 4}});
    CHECK(still.is_still(0));
    CHECK_FALSE(still.is_still(1));
    CHECK(still.is_still(3));
    CHECK(still.few_move());
    CHECK(std::vector(still.few_moving().begin(), still.few_moving().end()) ==
          std::vector<std::uint32_t>{1, 4});
    CHECK_FALSE(StillTriangles(5, Runs{{0, 2}}).few_move());

    const Animation animation(1, 0.5f, 10);
    TriangleView view = animation.view();
    view.triangles = view.triangles.first(view.triangles.size() - 1);
    GridBuilder builder;
    CHECK_THROWS_AS(builder.rebuild(view), std::invalid_argument);
}

}  // namespace gridreel::rebuild
