// Nested grids of still triangles, while moving ones come and go beside them.

#include "rebuild/last_frame.h"

#include "rebuild/grid_builder.h"
#include "soup.h"
#include "tests/rebuild/grid_contents.h"

#include <catch2/catch.hpp>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace gridreel::rebuild {
namespace {

/// Crowds of triangles in a box of 12 m that stays.
class Crowds {
public:
    Crowds() {
        add(2, glm::vec3{-1.0f}, 0.0f, 0.0f);
        add(2, glm::vec3{11.0f}, 0.0f, 0.0f);
    }

    /// @param spread  edge of the cube that their first corners are in, from `at` on
    void add(int count, const glm::vec3& at, float spread, float size) {
        for (int i = 0; i < count; ++i) {
            const auto first = static_cast<std::uint32_t>(soup_.positions.size());
            const glm::vec3 corner = at + spread * in_cube();
            for (int k = 0; k < 3; ++k) soup_.positions.push_back(corner + size * in_cube());
            soup_.triangles.emplace_back(first, first + 1, first + 2);
        }
    }

    /// All that is added from now on moves.
    void end_still() { still_ = soup_.triangles.size(); }

    void move(const glm::vec3& by) {
        for (std::size_t i = 3 * still_; i < soup_.positions.size(); ++i) soup_.positions[i] += by;
    }

    /// Builds the next frame, and compares it with the same one from scratch.
    BuildReport rebuild(GridBuilder& builder) {
        if (!known_) {
            known_ = std::make_shared<StillTriangles>(soup_.triangles.size(),
                                                      std::vector<TriangleRun>{{0, still_}});
        }
        TriangleView view = soup_.view();
        view.still = known_;
        const BuildReport report = builder.rebuild(view);
        GridBuilder fresh;
        (void)fresh.rebuild(soup_.view());
        REQUIRE(test::grid_contents(builder.grid()) == test::grid_contents(fresh.grid()));
        return report;
    }

private:
    glm::vec3 in_cube() {
        const auto uniform = [&] { return float(random_() >> 8) * 0x1p-24f; };
        const float x = uniform(), y = uniform(), z = uniform();
        return {x, y, z};
    }

    std::mt19937 random_{13};
    Soup soup_;
    std::size_t still_ = 0;
    std::shared_ptr<const StillTriangles> known_;
};

}  // namespace

TEST_CASE("a cell that a moving triangle has left is another nested grid", "[rebuild]") {
    Crowds crowds;
    crowds.add(500, glm::vec3{0.5f}, 0.0f, 0.01f);
    crowds.add(500, glm::vec3{0.0f}, 10.0f, 0.1f);
    crowds.end_still();
    crowds.add(1, glm::vec3{0.4f}, 0.0f, 0.3f);

    GridBuilder builder;
    for (int turn = 0; turn < 3; ++turn) {
        CHECK(crowds.rebuild(builder).nested_grids > 0);
        crowds.move(glm::vec3{8.0f});
        CHECK(crowds.rebuild(builder).nested_grids > 0);
        crowds.move(glm::vec3{-8.0f});
    }
}

TEST_CASE("grids in nested grids are found where those have other numbers", "[rebuild]") {
    // Two crowds that stand still, alike but for the crowds in them; a third one flies over both.
    Crowds crowds;
    crowds.add(400, glm::vec3{0.0f}, 10.0f, 0.1f);
    for (const float z : {4.2f, 7.5f}) {
        const glm::vec3 at{5.2f, 5.2f, z};
        crowds.add(1, at, 0.0f, 0.0f);
        crowds.add(1, at + 0.05f, 0.0f, 0.0f);
        crowds.add(800, at, 0.049f, 0.001f);
        crowds.add(2'000, at + 0.022f, 0.0005f, z * 5e-6f);
    }
    crowds.end_still();
    crowds.add(800, glm::vec3{5.2f, 5.2f, 1.3f}, 0.05f, 0.001f);

    GridBuilder builder;
    for (int turn = 0; turn < 3; ++turn) {
        CHECK(crowds.rebuild(builder).nested_grids >= 5);
        CHECK(builder.grid().levels[2].grids.size() >= 2);
        crowds.move({0, 0, 8.0f});
        CHECK(crowds.rebuild(builder).nested_grids >= 5);
        crowds.move({0, 0, -8.0f});
    }
}

}  // namespace gridreel::rebuild
