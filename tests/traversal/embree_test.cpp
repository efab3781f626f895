// Embree as one more oracle, and as a tracer in its own right. Without Embree the tests say so and pass.

#include "reference_intersection.h"
#include "skip_without_embree.h"
#include "test_rays.h"
#include "test_triangles.h"
#include "traversal/tracer.h"

#include <catch2/catch.hpp>

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_scheduler_observer.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sys/mman.h>

/// TBB keeps what it made for an observer until its worker threads end, which is after leaks are looked for.
extern "C" const char*
__lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" const char*
__lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
    return "leak:tbb::detail::r1::observe";
}

namespace gridreel::tests {
namespace {

using traversal::EmbreeOptions;
using traversal::EmbreeQuality;
using traversal::EmbreeRays;
using traversal::HitBatch;
using traversal::OcclusionBatch;
using traversal::RayBatch;
using traversal::Tracer;
using traversal::TracerKind;

std::unique_ptr<Tracer> embree(const EmbreeOptions& options = {}) {
    return traversal::make_tracer({.kind = TracerKind::embree, .resolution = {}, .embree = options});
}

std::unique_ptr<Tracer> grid() {
    return traversal::make_tracer({.kind = TracerKind::grid, .resolution = {}});
}

HitBatch closest(Tracer& tracer, const RayBatch& rays) {
    HitBatch hits;
    tracer.closest_hits(rays, hits);
    return hits;
}

OcclusionBatch blocked(Tracer& tracer, const RayBatch& rays) {
    OcclusionBatch occluded;
    tracer.any_hits(rays, occluded);
    return occluded;
}

bool is_hit(const HitBatch& hits, std::size_t ray) {
    return hits.triangle[ray] != traversal::no_triangle;
}

/// Whether rounding may decide otherwise: the ray passes close to an edge, or sees the triangle edge-on, or
/// its interval ends there.
bool is_doubtful(const Triangles& triangles, const RayBatch& rays, std::size_t ray, std::uint32_t triangle) {
    const auto hit =
        intersect(triangles, triangle, glm::dvec3{rays.origin_of(ray)}, glm::dvec3{rays.direction_of(ray)});
    return !hit || std::fabs(hit->inside) < 1e-4 || hit->facing < 1e-4 ||
           std::fabs(hit->t / double(rays.t_min[ray]) - 1.0) < 1e-4 ||
           std::fabs(hit->t / double(rays.t_max[ray]) - 1.0) < 1e-4;
}

struct Disagreement {
    std::size_t hit_or_miss = 0;  ///< rays that only one of the two sees hit
    std::size_t unexplained = 0;  ///< of those, the ones whose hit is clear
    std::size_t far_off = 0;      ///< rays whose t differs by more than rounding
};

Disagreement compare(const Triangles& triangles, const RayBatch& rays, const HitBatch& ours,
                     const HitBatch& theirs) {
    Disagreement found;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (is_hit(ours, i) != is_hit(theirs, i)) {
            ++found.hit_or_miss;
            const HitBatch& hitting = is_hit(ours, i) ? ours : theirs;
            found.unexplained += !is_doubtful(triangles, rays, i, hitting.triangle[i]);
        } else if (is_hit(ours, i) && std::fabs(ours.t[i] / theirs.t[i] - 1.0f) > 1e-5f) {
            // Another triangle may be the nearest only where one of the two is in doubt.
            found.far_off += !is_doubtful(triangles, rays, i, ours.triangle[i]) &&
                             !is_doubtful(triangles, rays, i, theirs.triangle[i]);
        }
    }
    return found;
}

std::vector<NamedRays> usual_batches(const Triangles& triangles) {
    const glm::vec3 eye{0.4f, 0.9f, 2.5f};
    std::vector<NamedRays> batches;
    batches.push_back({"pinhole", pinhole(eye, {0.1f, 0.0f, 0.0f}, 0.6f, 150)});
    batches.push_back({"from a point", from_point({0.31f, 0.17f, 0.23f}, 20'001, 31)});
    batches.push_back({"to surfaces", towards_surfaces(eye, triangles, 20'005)});
    RayBatch scattered;
    scattered.resize(20'003, std::nullopt, traversal::RayOrder::arbitrary);
    Random random(77);
    for (std::size_t i = 0; i < scattered.size(); ++i) {
        scattered.set_origin(i, random.in_box(-1.5f, 1.5f));
        scattered.set_direction(i, random.on_sphere() * random.uniform(0.1f, 3.0f));
        scattered.t_min[i] = random.uniform(0.0f, 0.2f);
        scattered.t_max[i] = random.uniform(0.0f, 3.0f);
    }
    batches.push_back({"scattered", std::move(scattered)});
    return batches;
}

/// Positions that end where a page ends, with nothing readable behind.
class PositionsAtPageEnd {
public:
    explicit PositionsAtPageEnd(std::span<const glm::vec3> values) : size_(round_up(values.size_bytes())) {
        void* const memory =
            mmap(nullptr, size_ + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        REQUIRE(memory != MAP_FAILED);
        memory_ = static_cast<char*>(memory);
        REQUIRE(mprotect(memory_ + size_, page, PROT_NONE) == 0);
        char* const first = memory_ + size_ - values.size_bytes();
        std::memcpy(first, values.data(), values.size_bytes());
        values_ = {reinterpret_cast<const glm::vec3*>(first), values.size()};
    }
    PositionsAtPageEnd(const PositionsAtPageEnd&) = delete;
    PositionsAtPageEnd& operator=(const PositionsAtPageEnd&) = delete;
    ~PositionsAtPageEnd() { munmap(memory_, size_ + page); }

    [[nodiscard]] std::span<const glm::vec3> values() const { return values_; }

private:
    static constexpr std::size_t page = 1 << 16;
    static std::size_t round_up(std::size_t bytes) { return (bytes + page - 1) / page * page; }

    std::size_t size_;
    char* memory_ = nullptr;
    std::span<const glm::vec3> values_;
};

}  // namespace

TEST_CASE("Embree and the grid agree but for rays within rounding of an edge", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    const auto quality = GENERATE(EmbreeQuality::low, EmbreeQuality::medium, EmbreeQuality::refit);
    const auto way = GENERATE(EmbreeRays::packets, EmbreeRays::sorted, EmbreeRays::single);
    const auto theirs = embree({.quality = quality, .rays = way});
    const auto ours = grid();
    std::ptrdiff_t hits = 0;
    for (const Triangles& triangles : {soup(3000, 0.1f), sheet(40), boxes(5)}) {
        ours->rebuild(triangles.view());
        theirs->rebuild(triangles.view());
        for (const auto& [name, rays] : usual_batches(triangles)) {
            INFO(triangles.name << ", " << name << ", " << name_of(quality));
            const HitBatch mine = closest(*ours, rays);
            hits += std::count_if(mine.t.begin(), mine.t.end(), [](float t) { return std::isfinite(t); });
            const Disagreement found = compare(triangles, rays, mine, closest(*theirs, rays));
            CHECK(found.hit_or_miss <= 5);
            CHECK(found.unexplained == 0);
            CHECK(found.far_off == 0);

            const OcclusionBatch a = blocked(*ours, rays), b = blocked(*theirs, rays);
            std::size_t differ = 0;
            for (std::size_t i = 0; i < a.size(); ++i) differ += a[i] != b[i];
            CHECK(differ <= 5);
        }
    }
    CHECK(hits > 50'000);
}

TEST_CASE("Embree follows triangles that move, and another topology", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    const auto quality = GENERATE(EmbreeQuality::low, EmbreeQuality::medium, EmbreeQuality::refit);
    INFO(name_of(quality));
    const auto theirs = embree({.quality = quality});
    const auto ours = grid();
    const RayBatch rays = pinhole({0.4f, 0.9f, 2.5f}, {}, 0.6f, 100);
    const auto check = [&](const Triangles& triangles) {
        ours->rebuild(triangles.view());
        const rebuild::BuildReport report = theirs->rebuild(triangles.view());
        CHECK(report.total_ms > 0.0);
        CHECK(report.bytes > triangles.triangles.size());
        const Disagreement found = compare(triangles, rays, closest(*ours, rays), closest(*theirs, rays));
        CHECK(found.hit_or_miss <= 3);
        CHECK(found.unexplained == 0);
        CHECK(found.far_off == 0);
    };

    // The same buffers with other contents, as a deforming mesh has them.
    Triangles triangles = sheet(30);
    for (int frame = 0; frame < 3; ++frame) {
        check(triangles);
        for (glm::vec3& p : triangles.positions) p = {p.x, p.y + 0.3f * std::sin(5.0f * p.x), p.z * 0.9f};
    }
    // Other corners in the same buffer.
    std::reverse(triangles.triangles.begin(), triangles.triangles.end());
    for (glm::uvec3& t : triangles.triangles) t.x = (t.x + 17) % std::uint32_t(triangles.positions.size());
    check(triangles);
    // Other buffers.
    check(soup(500, 0.2f));
    check(boxes(4));
}

TEST_CASE("Embree on nothing, and rays that hit nothing", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    const auto way = GENERATE(EmbreeRays::packets, EmbreeRays::sorted, EmbreeRays::single);
    const auto tracer = embree({.quality = EmbreeQuality::low, .rays = way});
    const Triangles none{.name = "none", .positions = {}, .triangles = {}};
    const RayBatch some = pinhole({0, 0, 3}, {}, 0.5f, 9);
    tracer->rebuild(none.view());
    for (const float t : closest(*tracer, some).t) CHECK(std::isinf(t));
    for (const auto hit : blocked(*tracer, some)) CHECK(hit == 0);

    // One big triangle before rays that make no sense; the last one does.
    Triangles wall{.name = "wall", .positions = {}, .triangles = {}};
    wall.add({-9, -9, 0}, {9, -9, 0}, {0, 9, 0});
    tracer->rebuild(wall.view());
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float inf = std::numeric_limits<float>::infinity();
    RayBatch rays;
    rays.resize(9, std::nullopt, traversal::RayOrder::arbitrary);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays.set_origin(i, {0, 0, 1});
        rays.set_direction(i, {0, 0, -1});
        rays.t_min[i] = 0.0f;
        rays.t_max[i] = 10.0f;
    }
    rays.set_direction(0, {0, 0, 0});
    rays.set_direction(1, {0, nan, -1});
    rays.set_direction(2, {0, 0, -inf});
    rays.set_origin(3, {nan, 0, 1});
    rays.set_origin(4, {0, 0, 2e12f});
    rays.t_min[5] = 10.0f;
    rays.t_max[6] = nan;
    rays.t_max[7] = 0.5f;
    const HitBatch hits = closest(*tracer, rays);
    const OcclusionBatch occluded = blocked(*tracer, rays);
    for (std::size_t i = 0; i < 8; ++i) {
        INFO(i);
        CHECK_FALSE(is_hit(hits, i));
        CHECK(std::isinf(hits.t[i]));
        CHECK(occluded[i] == 0);
    }
    CHECK(hits.t[8] == 1.0f);
    CHECK(hits.triangle[8] == 0);
    CHECK(occluded[8] == 1);

    // Broken triangles are not hit; the good ones among them are.
    const Triangles broken = degenerate(300);
    tracer->rebuild(broken.view());
    const auto ours = grid();
    ours->rebuild(broken.view());
    const RayBatch across = from_point({0.1f, 0.2f, 0.3f}, 5000, 5);
    CHECK(compare(broken, across, closest(*ours, across), closest(*tracer, across)).unexplained == 0);
}

TEST_CASE("positions may end where a page ends", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    const Triangles triangles = soup(500, 0.2f);
    const PositionsAtPageEnd positions(triangles.positions);
    const auto ours = grid(), theirs = embree();
    ours->rebuild(triangles.view());
    theirs->rebuild({.positions = positions.values(), .triangles = triangles.triangles});
    const RayBatch rays = pinhole({0.4f, 0.9f, 2.5f}, {}, 0.6f, 64);
    CHECK(compare(triangles, rays, closest(*ours, rays), closest(*theirs, rays)).unexplained == 0);
}

TEST_CASE("behind what they hit, Embree's rays meet what the grid's meet, and nothing twice",
          "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    // Each triangle twice, the second time from its back: of such twins Embree may leave one out.
    Triangles triangles = soup(400, 0.4f);
    const std::vector<glm::uvec3> once = triangles.triangles;
    for (const glm::uvec3& t : once) triangles.triangles.emplace_back(t.x, t.z, t.y);
    RayBatch rays = pinhole({0.4f, 0.9f, 2.5f}, {}, 0.4f, 40);
    const auto all_met = [&](Tracer& tracer) {
        tracer.rebuild(triangles.view());
        std::vector<std::vector<std::uint32_t>> met(rays.size());
        rays.after_triangle.resize(0);
        HitBatch hits = closest(tracer, rays);
        std::vector<std::uint32_t> rays_going(rays.size());
        for (std::size_t i = 0; i < rays.size(); ++i) rays_going[i] = std::uint32_t(i);
        std::size_t rounds = 0;
        while (!rays_going.empty()) {
            REQUIRE(++rounds <= triangles.triangles.size() + 1);
            std::vector<std::uint32_t> still;
            RayBatch rest;
            for (std::size_t i = 0; i < rays_going.size(); ++i) {
                if (!is_hit(hits, i)) continue;
                met[rays_going[i]].push_back(hits.triangle[i]);
                still.push_back(rays_going[i]);
            }
            rest.resize(still.size(), rays.common_origin, traversal::RayOrder::coherent);
            rest.after_triangle.resize(still.size());
            for (std::size_t i = 0; i < still.size(); ++i) {
                rest.set_direction(i, rays.direction_of(still[i]));
                rest.t_min[i] = rays.t_min[still[i]];
                rest.t_max[i] = rays.t_max[still[i]];
                rest.after_triangle[i] = met[still[i]].back();
            }
            hits = closest(tracer, rest);
            rays_going = still;
        }
        for (auto& list : met) std::sort(list.begin(), list.end());
        return met;
    };
    const auto ours = all_met(*grid()), theirs = all_met(*embree());
    const auto places = [&](std::vector<std::uint32_t> met) {
        for (std::uint32_t& triangle : met) triangle %= std::uint32_t(once.size());
        std::sort(met.begin(), met.end());
        met.erase(std::unique(met.begin(), met.end()), met.end());
        return met;
    };
    std::size_t hits = 0, different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hits += ours[i].size();
        different += places(ours[i]) != places(theirs[i]);
        CHECK(std::adjacent_find(theirs[i].begin(), theirs[i].end()) == theirs[i].end());
    }
    CHECK(hits > 5 * rays.size());
    CHECK(different <= rays.size() / 1000);
}

TEST_CASE("Embree keeps to the threads of the caller's arena", "[traversal][embree]") {
    SKIP_WITHOUT_EMBREE();
    struct Workers : tbb::task_scheduler_observer {
        Workers() { observe(true); }
        ~Workers() override { observe(false); }
        void on_scheduler_entry(bool is_worker) override { joined += is_worker; }
        std::atomic<int> joined{0};
    };
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
    const Triangles triangles = soup(60'000, 0.05f);
    const RayBatch rays = pinhole({0.4f, 0.9f, 2.5f}, {}, 0.6f, 128);
    HitBatch one, many;
    const auto quality = GENERATE(EmbreeQuality::low, EmbreeQuality::medium, EmbreeQuality::refit);
    const auto trace = [&](int threads, HitBatch& hits) {
        tbb::task_arena(threads).execute([&] {
            const auto tracer = embree({.quality = quality});
            tracer->rebuild(triangles.view());
            tracer->closest_hits(rays, hits);
        });
    };
    {
        const Workers workers;
        trace(1, one);
        CHECK(workers.joined == 0);
    }
    trace(3, many);
    CHECK(compare(triangles, rays, one, many).hit_or_miss == 0);
}

TEST_CASE("names of tracers stand for themselves, built in or not", "[traversal]") {
    for (const TracerKind kind :
         {TracerKind::grid, TracerKind::grid_single, TracerKind::naive, TracerKind::embree}) {
        CHECK(traversal::tracer_kind(name_of(kind)) == kind);
        const auto kinds = traversal::tracer_kinds();
        CHECK(traversal::is_built_in(kind) == (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()));
        if (!traversal::is_built_in(kind)) {
            CHECK_THROWS_AS(traversal::make_tracer({.kind = kind, .resolution = {}}), std::invalid_argument);
        }
    }
    CHECK_FALSE(traversal::tracer_kind("octree"));
}

}  // namespace gridreel::tests
