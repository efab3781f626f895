// Whatever packets are made of, and whatever they leave out, answers stay the same.

#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gridreel::tests {
namespace {

using traversal::HitBatch;
using traversal::make_tracer;
using traversal::OcclusionBatch;
using traversal::PacketOptions;
using traversal::RayBatch;
using traversal::Tracer;
using traversal::TraceReport;
using traversal::TracerKind;

constexpr float lambda_of_the_paper = 5.0f;

std::unique_ptr<Tracer> packets(const PacketOptions& options, float lambda = lambda_of_the_paper) {
    return make_tracer({.resolution = {.lambda = lambda}, .packets = options});
}

/// Every way to switch culling, mailbox and macrocells.
std::vector<PacketOptions> all_switches(std::optional<int> side) {
    std::vector<PacketOptions> all;
    for (const bool culling : {true, false}) {
        for (const bool mailbox : {true, false}) {
            for (const bool macrocells : {false, true}) {
                all.push_back(
                    {.side = side, .culling = culling, .mailbox = mailbox, .macrocells = macrocells});
            }
        }
    }
    return all;
}

/// A batch with a common origin or direction, and the answers of single rays.
struct Question {
    NamedRays batch;
    HitBatch hits;
    OcclusionBatch blocked;
};

std::vector<Question> questions(const Triangles& triangles, std::size_t rays_per_batch) {
    const auto single =
        make_tracer({.kind = TracerKind::grid_single, .resolution = {.lambda = lambda_of_the_paper}});
    single->rebuild(triangles.view());
    std::vector<Question> all;
    for (NamedRays& batch : nasty_batches(triangles, rays_per_batch)) {
        if (!batch.rays.common_origin && !batch.rays.common_direction)
            continue;  // no packets are made of those
        Question& question = all.emplace_back();
        single->closest_hits(batch.rays, question.hits);
        single->any_hits(batch.rays, question.blocked);
        question.batch = std::move(batch);
    }
    return all;
}

template <class Values>
bool same(const Values& a, const Values& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

void check_options(const Triangles& triangles, const std::vector<Question>& asked,
                   const PacketOptions& options) {
    const auto tracer = packets(options);
    tracer->rebuild(triangles.view());
    HitBatch hits;
    OcclusionBatch blocked;
    for (const Question& question : asked) {
        INFO(triangles.name << ", " << question.batch.name << ", side " << options.side.value_or(0)
                            << ", culling " << options.culling << ", mailbox " << options.mailbox
                            << ", macrocells " << options.macrocells);
        tracer->closest_hits(question.batch.rays, hits);
        CHECK(same(question.hits.t, hits.t));
        CHECK(same(question.hits.triangle, hits.triangle));
        tracer->any_hits(question.batch.rays, blocked);
        CHECK(same(question.blocked, blocked));
    }
}

/// In turns through these triangles, with every switch and side.
void check_all_options(const std::vector<Triangles>& scenes, std::size_t rays_per_batch) {
    for (const Triangles& triangles : scenes) {
        const std::vector<Question> asked = questions(triangles, rays_per_batch);
        for (const std::optional<int> side :
             {std::optional<int>(), std::optional(1), std::optional(2), std::optional(4), std::optional(7),
              std::optional(8), std::optional(16)}) {
            for (const PacketOptions& options : all_switches(side)) check_options(triangles, asked, options);
        }
    }
}

/// Two small heaps of triangles at the ends of a long hall, and a camera at one end.
Triangles hall() {
    Triangles ends = scaled(soup(400, 0.1f), 1.0f, {0.0f, 0.0f, -30.0f});
    const Triangles other = scaled(soup(400, 0.1f), 1.0f, {0.0f, 0.0f, 30.0f});
    for (const glm::uvec3& t : other.triangles)
        ends.add(other.positions[t.x], other.positions[t.y], other.positions[t.z]);
    return ends;
}

/// Clusters of triangles smaller than a cell, with empty cubes of cells before and behind most of them.
Triangles clusters() {
    Triangles result{.name = "clusters", .positions = {}, .triangles = {}};
    Random random(31);
    for (int cluster = 0; cluster < 20; ++cluster) {
        const glm::vec3 at = random.in_box(-1.0f, 1.0f);
        for (int i = 0; i < 60; ++i) {
            const glm::vec3 corner = at + random.in_box(-0.06f, 0.06f);
            result.add(corner, corner + random.in_box(-0.02f, 0.02f), corner + random.in_box(-0.02f, 0.02f));
        }
    }
    return result;
}

}  // namespace

TEST_CASE("packets of any side, with or without culling, mailbox and macrocells, give the same answers",
          "[traversal][oracle]") {
    SECTION("surfaces and heaps") {
        check_all_options({soup(250, 0.15f), sheet(12)}, 280);
    }
    SECTION("equal depths and axis-aligned faces") {
        check_all_options({coplanar(40), boxes(3)}, 280);
    }
    SECTION("long, degenerate and absurd triangles") {
        check_all_options({slivers(80), degenerate(150)}, 280);
    }
    SECTION("nested grids") {
        check_all_options({crowds_in_crowds()}, 280);
    }
    SECTION("much empty space") {
        check_all_options({hall(), clusters()}, 280);
    }
    SECTION("tiny, huge and far scenes") {
        check_all_options(
            {scaled(soup(60, 0.3f), 1e-8f, {}), scaled(soup(60, 0.3f), 1e6f, {3e6f, -2e6f, 5e6f}),
             scaled(sheet(6), 1.0f, {1000.0f, 2000.0f, 3000.0f})},
            280);
    }
}

TEST_CASE("answers do not depend on packets whose batches are long", "[traversal][oracle]") {
    // Whole packets of every side, and of neighbours of which some are tried before others.
    for (const Triangles& triangles : {soup(400, 0.1f), teapot_in_stadium()}) {
        const std::vector<Question> asked = questions(triangles, 5000);
        for (const int side : {4, 16}) {
            check_options(triangles, asked, {.side = side});
            check_options(triangles, asked,
                          {.side = side, .culling = false, .mailbox = false, .macrocells = true});
        }
        check_options(triangles, asked, {.side = {}, .culling = false, .mailbox = false, .macrocells = true});
    }
}

TEST_CASE("a packet's side is 1 to 16", "[traversal]") {
    for (const int side : {0, 17, -1}) {
        INFO(side);
        CHECK_THROWS_AS(packets({.side = side}), std::invalid_argument);
    }
    CHECK_NOTHROW(packets({.side = 1}));
    CHECK_NOTHROW(packets({.side = traversal::widest_packet_side}));
}

TEST_CASE("macrocells spare packets the cells of empty space", "[traversal]") {
    const Triangles triangles = hall();
    for (const float from : {-40.0f, 40.0f}) {
        for (const std::optional<int> side : {std::optional<int>(), std::optional(8)}) {
            INFO("from " << from << ", side " << side.value_or(0));
            const RayBatch rays = pinhole({0.1f, 0.2f, from}, {}, 0.1f, 64);
            const auto cells = [&](bool macrocells) {
                HitBatch hits;
                const auto tracer = packets({.side = side, .macrocells = macrocells});
                tracer->rebuild(triangles.view());
                const TraceReport report = tracer->closest_hits(rays, hits);
                CHECK(std::count(hits.triangle.begin(), hits.triangle.end(), traversal::no_triangle) > 0);
                return report.cells;
            };
            CHECK(2 * cells(true) < cells(false));
        }
    }
}

TEST_CASE("macrocells follow the triangles, and cost memory", "[traversal]") {
    const auto with = packets({.side = {}, .macrocells = true}), without = packets({});
    const Triangles first = hall(), second = soup(300, 0.2f);
    const RayBatch rays = pinhole({0.3f, 0.4f, 3.0f}, {}, 0.5f, 48);
    CHECK(with->rebuild(first.view()).bytes > without->rebuild(first.view()).bytes);
    HitBatch expected, actual;
    for (const Triangles& triangles : {second, first, Triangles{}, second}) {
        with->rebuild(triangles.view());
        without->rebuild(triangles.view());
        with->closest_hits(rays, actual);
        without->closest_hits(rays, expected);
        CHECK(same(expected.triangle, actual.triangle));
    }
}

TEST_CASE("culling and the mailbox each spare ray-triangle intersections", "[traversal]") {
    const Triangles triangles = soup(4000, 0.05f);
    const RayBatch rays = pinhole({0.3f, 0.4f, 3.0f}, {}, 0.5f, 128);
    const auto tests = [&](bool culling, bool mailbox) {
        HitBatch hits;
        const auto tracer = packets({.side = 16, .culling = culling, .mailbox = mailbox});
        tracer->rebuild(triangles.view());
        return tracer->closest_hits(rays, hits).triangle_tests;
    };
    const auto neither = tests(false, false);
    CHECK(tests(true, false) < neither);
    CHECK(tests(false, true) < neither);
    CHECK(tests(true, true) < std::min(tests(true, false), tests(false, true)));
}

}  // namespace gridreel::tests
