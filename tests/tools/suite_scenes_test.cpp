#include "tests/tools/played.h"
#include "tools/gallery/scenes.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gridreel::gallery;

namespace {

constexpr double frame_s = 1.0 / 24.0;

std::string glb_of(const Document& document) {
    std::ostringstream out;
    write_glb(document, out);
    return out.str();
}

/// Longest side over the height above it.
double aspect(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    return longest * longest / glm::length(glm::cross(b - a, c - a));
}

double volume(const std::vector<glm::vec3>& points) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::vec3& p : points) {
        low = glm::min(low, glm::dvec3(p));
        high = glm::max(high, glm::dvec3(p));
    }
    const glm::dvec3 size = high - low;
    return size.x * size.y * size.z;
}

}  // namespace

TEST_CASE("a scene to measure with is the same bytes every time", "[gallery]") {
    for (const SceneMaker& scene : scene_makers) {
        if (scene.place != Place::on_demand) continue;
        INFO(scene.name);
        const bool repeats = glb_of(scene.make(5'000)) == glb_of(scene.make(5'000));
        CHECK(repeats);
    }
}

TEST_CASE("every triangle of a scene to measure with moves in every frame", "[gallery]") {
    for (const SceneMaker& scene : scene_makers) {
        if (scene.place != Place::on_demand) continue;
        INFO(scene.name);
        Played played(scene.make(3'000));
        const int frames = static_cast<int>(std::floor(played.duration_s() / frame_s + 1e-6));
        REQUIRE(frames >= 60);
        for (int frame = 0; frame < frames; ++frame) {
            INFO(frame);
            REQUIRE(played.standing_still(frame * frame_s, (frame + 1) * frame_s) == 0);
        }
    }
}

TEST_CASE("a scene to measure with has one camera and one point light", "[gallery]") {
    for (const SceneMaker& scene : scene_makers) {
        if (scene.place != Place::on_demand) continue;
        INFO(scene.name);
        const Document document = scene.make(2'000);
        CHECK(document.cameras.size() == 1);
        CHECK(document.lights.size() == 1);
    }
}

TEST_CASE("soup's triangles drift as wholes, each its own way", "[gallery]") {
    Played soup(make_soup(500));
    const auto first = soup.positions(0.0), last = soup.positions(soup.duration_s());
    glm::vec3 previous(0.0f);
    for (const glm::uvec3& t : soup.triangles()) {
        const glm::vec3 drift = last[t.x] - first[t.x];
        CHECK(glm::length(last[t.y] - first[t.y] - drift) < 1e-6f);
        CHECK(glm::length(last[t.z] - first[t.z] - drift) < 1e-6f);
        CHECK(glm::length(drift - previous) > 1e-3f);
        previous = drift;
    }
}

TEST_CASE("eight times the soup has triangles half as long", "[gallery]") {
    const auto mean_edge = [](std::size_t count) {
        Played soup(make_soup(count));
        const auto p = soup.positions(0.0);
        double sum = 0.0;
        for (const glm::uvec3& t : soup.triangles()) sum += double(glm::length(p[t.y] - p[t.x]));
        return sum / double(soup.triangles().size());
    };
    // Two uniform points in a cube of side s are 0.6617 s apart in the mean (Robbins' constant);
    // here s = 2.4 / cbrt(8000) = 0.12.
    CHECK(mean_edge(8'000) == Approx(0.6617 * 0.12).epsilon(0.02));
    CHECK(mean_edge(64'000) == Approx(0.6617 * 0.06).epsilon(0.02));
}

TEST_CASE("needles are at least a hundred times as long as wide, and stay so while they spin", "[gallery]") {
    Played needles(make_needles(600));
    const auto rest = needles.positions(0.0);
    for (const double time_s : {0.0, 0.7, 2.9}) {
        const auto p = needles.positions(time_s);
        for (const glm::uvec3& t : needles.triangles()) {
            CHECK(aspect(p[t.x], p[t.y], p[t.z]) >= 100.0);
            const float length = glm::length(rest[t.z] - rest[t.x]);
            CHECK(glm::length(p[t.z] - p[t.x]) == Approx(length).epsilon(1e-3));
        }
    }
}

TEST_CASE("needles point somewhere else a third of a second later", "[gallery]") {
    Played needles(make_needles(600));
    const auto before = needles.positions(1.0), after = needles.positions(4.0 / 3.0);
    for (const glm::uvec3& t : needles.triangles()) {
        const glm::vec3 was = glm::normalize(before[t.z] - before[t.x]);
        const glm::vec3 is = glm::normalize(after[t.z] - after[t.x]);
        // One turn in 6 s at least: 20 degrees.
        CHECK(glm::dot(was, is) < 0.95f);
    }
}

TEST_CASE("the exploding shell's box grows with every second, to many times its size", "[gallery]") {
    Played exploding(make_exploding(4'000));
    double previous = volume(exploding.positions(0.0));
    CHECK(previous < 3.0 * 3.0 * 3.0);
    for (const double time_s : {1.0, 2.0, 3.0, 4.0}) {
        const double now = volume(exploding.positions(time_s));
        CHECK(now > 1.1 * previous);
        previous = now;
    }
    CHECK(previous > 100.0);
}

TEST_CASE("pieces of the exploding shell neither stretch nor lose triangles", "[gallery]") {
    Played exploding(make_exploding(4'000));
    CHECK(std::abs(double(exploding.triangles().size()) - 4'000.0) <= 80.0);
    const auto first = exploding.positions(0.0), last = exploding.positions(exploding.duration_s());
    for (const glm::uvec3& t : exploding.triangles())
        CHECK(glm::length(last[t.y] - last[t.x]) ==
              Approx(glm::length(first[t.y] - first[t.x])).margin(1e-4));
}

TEST_CASE("the forest's figure has nearly all triangles", "[gallery]") {
    Played forest(make_forest(174'000));
    const auto positions = forest.positions(1.0);
    std::size_t fine = 0, coarse = 0;
    double longest_fine = 0.0, longest_coarse = 0.0;
    glm::vec3 low(1e9f), high(-1e9f);
    for (const auto& part : forest.parts()) {
        (part.skinned ? fine : coarse) += part.triangle_count;
        for (std::size_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
            const glm::uvec3& corners = forest.triangles()[t];
            for (int i = 0; i < 3; ++i) {
                const glm::vec3& p = positions[corners[i]];
                const double edge = double(glm::length(positions[corners[(i + 1) % 3]] - p));
                if (part.skinned) {
                    low = glm::min(low, p);
                    high = glm::max(high, p);
                    longest_fine = std::max(longest_fine, edge);
                } else {
                    longest_coarse = std::max(longest_coarse, edge);
                }
            }
        }
    }
    CHECK(std::abs(double(fine + coarse) - 174'000.0) <= 0.02 * 174'000.0);
    CHECK(coarse < 6'000);
    CHECK(coarse > 4'000);
    // A person, walking; ground squares of 5 m.
    CHECK(high.y - low.y == Approx(1.8).margin(0.1));
    CHECK(longest_fine < 0.03);
    CHECK(longest_coarse > 5.0);
}
