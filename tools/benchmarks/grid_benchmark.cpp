// Rebuild, primary rays and rays of a mirror below on a waving sheet, the tracers side by side: 1024 x 1024
// rays, 1 and 2 threads. Interleave them when the machine is noisy: --benchmark_enable_random_interleaving
// --benchmark_repetitions=5.

#include "traversal/simd_target.h"
#include "traversal/tracer.h"

#include <benchmark/benchmark.h>

#include <glm/geometric.hpp>

#include <tbb/task_arena.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace {

using namespace gridreel;

struct Sheet {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

/// A height field of about `count` triangles over [-1, 1]^2.
Sheet sheet(std::int64_t count) {
    const auto side = static_cast<std::uint32_t>(std::sqrt(double(count) / 2.0));
    Sheet result;
    for (std::uint32_t j = 0; j <= side; ++j) {
        for (std::uint32_t i = 0; i <= side; ++i) {
            const float x = 2.0f * float(i) / float(side) - 1.0f, y = 2.0f * float(j) / float(side) - 1.0f;
            const float z = 0.1f * std::sin(6.0f * x) + 0.08f * std::sin(9.0f * y) +
                            0.03f * std::sin(25.0f * x + 20.0f * y);
            result.positions.emplace_back(x, y, z);
        }
    }
    for (std::uint32_t j = 0; j < side; ++j) {
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + side + 1;
            result.triangles.emplace_back(a, a + 1, b + 1);
            result.triangles.emplace_back(a, b + 1, b);
        }
    }
    return result;
}

/// Even bits of a Morton code.
std::uint32_t every_other_bit(std::uint32_t code) {
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < 16; ++i) bits |= (code >> (2 * i) & 1u) << i;
    return bits;
}

/// 1024 x 1024 camera rays along the Morton curve.
traversal::RayBatch camera_rays() {
    constexpr std::uint32_t side = 1024;
    const glm::vec3 eye{0.3f, -2.1f, 1.25f}, forward = glm::normalize(glm::vec3{-0.12f, 1.0f, -0.6f});
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3{0.0f, 0.0f, 1.0f}));
    const glm::vec3 up = glm::cross(right, forward);
    traversal::RayBatch rays;
    rays.resize(side * side, eye, traversal::RayOrder::coherent);
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const float x = 2.0f * (float(every_other_bit(i)) + 0.5f) / float(side) - 1.0f;
        const float y = 2.0f * (float(every_other_bit(i >> 1)) + 0.5f) / float(side) - 1.0f;
        rays.set_direction(i, forward + 0.42f * (x * right - y * up));
        rays.t_min[i] = 0.0f;
        rays.t_max[i] = std::numeric_limits<float>::infinity();
    }
    return rays;
}

/// The camera's rays as they leave a mirror below the sheet.
/// @param ripple  slope of the mirror's waves; 0: it is flat
traversal::RayBatch mirror_rays(float ripple) {
    constexpr float height = -0.4f;
    const traversal::RayBatch seen = camera_rays();
    traversal::RayBatch rays;
    rays.resize(seen.size(), std::nullopt, traversal::RayOrder::coherent);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const glm::vec3 from = seen.origin_of(i), way = seen.direction_of(i);
        const glm::vec3 at = from + way * ((height - from.z) / way.z);
        const glm::vec3 normal =
            glm::normalize(glm::vec3{ripple * std::sin(3.0f * at.x), ripple * std::sin(4.0f * at.y), 1.0f});
        rays.set_origin(i, at);
        rays.set_direction(i, way - 2.0f * glm::dot(way, normal) * normal);
        rays.t_min[i] = 0.0f;
        rays.t_max[i] = std::numeric_limits<float>::infinity();
    }
    return rays;
}

void rebuild_grid(benchmark::State& state) {
    const Sheet triangles = sheet(state.range(0));
    tbb::task_arena arena(static_cast<int>(state.range(1)));
    const auto tracer = traversal::make_tracer({});
    for (auto _ : state) {
        arena.execute([&] {
            benchmark::DoNotOptimize(tracer->rebuild({triangles.positions, triangles.triangles}));
        });
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles.triangles.size()));
}

void trace(benchmark::State& state, traversal::TracerKind kind, const traversal::RayBatch& rays) {
    const Sheet triangles = sheet(state.range(0));
    tbb::task_arena arena(static_cast<int>(state.range(1)));
    const auto tracer = traversal::make_tracer({.kind = kind, .resolution = {}});
    traversal::HitBatch hits;
    traversal::TraceReport report;
    arena.execute([&] { tracer->rebuild({triangles.positions, triangles.triangles}); });
    for (auto _ : state) {
        arena.execute([&] { report = tracer->closest_hits(rays, hits); });
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size()));
    state.counters["tests_per_ray"] = double(report.triangle_tests) / double(rays.size());
    state.SetLabel(std::string(traversal::simd_target()));
}

void primary_rays(benchmark::State& state, traversal::TracerKind kind) {
    trace(state, kind, camera_rays());
}

void flat_mirror(benchmark::State& state, traversal::TracerKind kind) {
    trace(state, kind, mirror_rays(0.0f));
}

void rippled_mirror(benchmark::State& state, traversal::TracerKind kind) {
    trace(state, kind, mirror_rays(0.1f));
}

void sizes(benchmark::internal::Benchmark* b) {
    b->ArgsProduct({{10'000, 80'000, 1'000'000}, {1, 2}})->ArgNames({"triangles", "threads"});
    b->UseRealTime()->Unit(benchmark::kMillisecond);
}

BENCHMARK(rebuild_grid)->Apply(sizes);
BENCHMARK_CAPTURE(primary_rays, grid, traversal::TracerKind::grid)->Apply(sizes);
BENCHMARK_CAPTURE(primary_rays, grid_single, traversal::TracerKind::grid_single)->Apply(sizes);
BENCHMARK_CAPTURE(flat_mirror, grid, traversal::TracerKind::grid)->Apply(sizes);
BENCHMARK_CAPTURE(flat_mirror, grid_single, traversal::TracerKind::grid_single)->Apply(sizes);
BENCHMARK_CAPTURE(rippled_mirror, grid, traversal::TracerKind::grid)->Apply(sizes);
BENCHMARK_CAPTURE(rippled_mirror, grid_single, traversal::TracerKind::grid_single)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
