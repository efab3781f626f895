#include "sequences/benchmark_json.h"

#include "sequences/build_info.h"
#include "sequences/errors.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <fstream>
#include <string>
#include <thread>

namespace gridreel::sequences {
namespace {

using Json = nlohmann::ordered_json;

std::string name_of(const std::string& scene, const CompetitorFigures& competitor,
                    const PhaseFigures& phase) {
    return fmt::format("{}/{}/threads:{}/{}", scene, competitor.name, competitor.threads, phase.name);
}

Json context(std::string_view instruction_set) {
    const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    return {{"date", fmt::format("{:%Y-%m-%dT%H:%M:%S}+00:00", fmt::gmtime(now))},
            {"executable", "gridreel bench"},
            {"version", version()},
            {"compiler", compiler()},
            {"cpu", cpu_name()},
            {"num_cpus", std::thread::hardware_concurrency()},
            {"instruction_set", instruction_set},
#ifdef NDEBUG
            {"library_build_type", "release"},
#else
            {"library_build_type", "debug"},
#endif
            {"peak_bytes", peak_memory_bytes()}};
}

Json entry(const SceneFigures& scene, const CompetitorFigures& competitor, const PhaseFigures& phase) {
    const std::string name = name_of(scene.scene, competitor, phase);
    Json json{{"name", name},
              {"run_name", name},
              {"run_type", "aggregate"},
              {"aggregate_name", "median"},
              {"repetitions", phase.ms.size()},
              {"threads", competitor.threads},
              {"iterations", phase.ms.size()},
              {"real_time", phase.median_ms},
              {"cpu_time", phase.median_ms},
              {"time_unit", "ms"},
              {"scene", scene.scene},
              {"accel", competitor.name},
              {"phase", phase.name},
              {"min", phase.min_ms},
              {"p95", phase.p95_ms}};
    if (phase.rays_per_second > 0.0) json["items_per_second"] = phase.rays_per_second;
    if (phase.cells_per_ray > 0.0 || phase.tests_per_ray > 0.0) {
        json["cells_per_ray"] = phase.cells_per_ray;
        json["triangle_tests_per_ray"] = phase.tests_per_ray;
    }
    if (phase.extra_bytes_per_triangle > 0.0) {
        json["extra_bytes_per_triangle"] = phase.extra_bytes_per_triangle;
    }
    if (!phase.way.empty()) json["rays"] = phase.way;
    if (phase.name == "rebuild") {
        json["triangles"] = {{"moving", scene.moving_triangles}, {"still", scene.still_triangles}};
        // As written: 0.35 and not 0.3499999940395355.
        if (competitor.lambda > 0.0f) json["lambda"] = std::stod(fmt::format("{}", competitor.lambda));
        json["grid"] = {competitor.resolution.x, competitor.resolution.y, competitor.resolution.z};
        json["cells"] = competitor.cells;
        json["references"] = competitor.references;
        json["bytes_per_triangle"] = competitor.bytes_per_triangle;
    }
    if (phase.name == "frame") json["rebuild_share"] = competitor.rebuild_share;
    json["times"] = phase.ms;
    return json;
}

bool is_compared(std::string_view phase) {
    return phase != "animate" && phase != "making";
}

UsageError not_a_baseline(const std::filesystem::path& file, std::string_view why) {
    return {fmt::format("no baseline of gridreel bench: {}", why),
            fmt::format("--baseline {}", file.string()), "give a file that --json has written"};
}

}  // namespace

std::string benchmark_json(std::span<const SceneFigures> scenes, std::string_view instruction_set) {
    Json benchmarks = Json::array(), ratios = Json::array();
    for (const SceneFigures& scene : scenes) {
        for (const CompetitorFigures& competitor : scene.competitors) {
            for (const PhaseFigures& phase : competitor.phases)
                benchmarks.push_back(entry(scene, competitor, phase));
        }
        for (const Ratio& ratio : scene.ratios) {
            ratios.push_back({{"scene", ratio.scene},
                              {"phase", ratio.phase},
                              {"against", ratio.against},
                              {"threads", ratio.threads},
                              {"speedup", ratio.speedup},
                              {"ours_ms", ratio.ours_ms},
                              {"theirs_ms", ratio.theirs_ms}});
        }
    }
    const Json json{{"context", context(instruction_set)}, {"benchmarks", benchmarks}, {"ratios", ratios}};
    // File names need not be UTF-8.
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Baseline read_baseline(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw not_a_baseline(file, "the file cannot be read");
    const Json json = Json::parse(stream, nullptr, false);
    if (json.is_discarded()) throw not_a_baseline(file, "it is not JSON");
    if (!json.is_object() || !json.contains("benchmarks") || !json["benchmarks"].is_array()) {
        throw not_a_baseline(file, "it has no array \"benchmarks\"");
    }
    Baseline baseline;
    for (const Json& benchmark : json["benchmarks"]) {
        const bool sound = benchmark.is_object() && benchmark.contains("name") &&
                           benchmark["name"].is_string() && benchmark.contains("real_time") &&
                           benchmark["real_time"].is_number() && benchmark.value("time_unit", Json()) == "ms";
        if (!sound) throw not_a_baseline(file, "a benchmark lacks its name, real_time, or time_unit ms");
        baseline[benchmark["name"].get<std::string>()] = benchmark["real_time"].get<double>();
    }
    return baseline;
}

BaselineComparison compare_with(const Baseline& baseline, std::span<const SceneFigures> scenes,
                                double allowed) {
    BaselineComparison comparison;
    for (const SceneFigures& scene : scenes) {
        for (const CompetitorFigures& competitor : scene.competitors) {
            for (const PhaseFigures& phase : competitor.phases) {
                if (!is_compared(phase.name)) continue;
                const std::string name = name_of(scene.scene, competitor, phase);
                const auto before = baseline.find(name);
                if (before == baseline.end()) {
                    comparison.unknown.push_back(name);
                    continue;
                }
                ++comparison.compared;
                const double change = phase.median_ms / before->second - 1.0;
                if (phase.median_ms <= before->second * (1.0 + allowed)) continue;
                comparison.regressed.push_back(
                    fmt::format("{}: {:.3f} ms against {:.3f} ms before, {:.1f}% slower", name,
                                phase.median_ms, before->second, 100.0 * change));
            }
        }
    }
    return comparison;
}

}  // namespace gridreel::sequences
