#include "sequences/benchmark.h"

#include "anim/load.h"
#include "sequences/timing_table.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>

namespace gridreel::sequences {
namespace {

using Report = engine::FrameReport;

struct Phase {
    std::string_view name;
    double (*ms)(const Report&);
};

constexpr std::array phases{
    Phase{"animate", [](const Report& r) { return r.animate_ms; }},
    Phase{"rebuild", [](const Report& r) { return r.rebuild.total_ms; }},
    Phase{"primary", [](const Report& r) { return r.primary_ms; }},
    Phase{"shadow", [](const Report& r) { return r.shadow_ms; }},
    Phase{"shade", [](const Report& r) { return r.shade_ms; }},
    Phase{"frame",
          [](const Report& r) { return r.animate_ms + r.rebuild.total_ms + r.trace_ms + r.shade_ms; }},
};

template <class Value>
double median(const Competitor& competitor, const Value& value) {
    std::vector<double> values;
    for (const Report& run : competitor.runs) values.push_back(value(run));
    return spread_of(std::move(values)).median;
}

double million_rays_a_second(std::uint64_t rays, double ms) {
    return ms > 0.0 ? double(rays) / ms / 1e3 : 0.0;
}

std::string row(const Competitor& competitor) {
    std::string text = fmt::format("{:<12} {:>7}", name_of(competitor.tracer), competitor.threads);
    for (const Phase& phase : phases) text += fmt::format(" {:>9.2f}", median(competitor, phase.ms));
    text += fmt::format(
        " {:>9.2f} {:>9.2f}\n",
        median(competitor,
               [](const Report& r) { return million_rays_a_second(r.primary.rays, r.primary_ms); }),
        median(competitor,
               [](const Report& r) { return million_rays_a_second(r.shadow.rays, r.shadow_ms); }));
    return text;
}

/// How many times faster `first` was: the median of the ratios run by run, which neighbours in time make.
std::string ratios(const Competitor& first, const Competitor& other) {
    std::string text = fmt::format("{} against {}, {} thread{}:", name_of(first.tracer),
                                   name_of(other.tracer), first.threads, first.threads == 1 ? "" : "s");
    for (const Phase& phase : phases) {
        if (phase.name == "animate" || phase.name == "shade") continue;
        std::vector<double> ratio;
        for (std::size_t i = 0; i < first.runs.size(); ++i) {
            const double ours = phase.ms(first.runs[i]), theirs = phase.ms(other.runs[i]);
            if (ours > 0.0 && theirs > 0.0) ratio.push_back(theirs / ours);
        }
        if (!ratio.empty())
            text += fmt::format(" {} {:.2f}x", phase.name, spread_of(std::move(ratio)).median);
    }
    return text + "\n";
}

}  // namespace

std::vector<Competitor> run_benchmark(const BenchmarkPlan& plan,
                                      const std::function<void(std::size_t, std::size_t)>& frame_done) {
    const anim::Scene scene = anim::load(plan.take.scene_file);
    const anim::Clip clip = choose_clip(scene, plan.take);
    const std::vector<Frame> frames = choose_frames(plan.take, clip, FramePattern("none.####.exr"));
    check_camera(scene, clip, plan.render.camera);

    // One renderer for each, so that each keeps its own memory from frame to frame.
    std::vector<Competitor> competitors;
    std::vector<std::unique_ptr<engine::FrameRenderer>> renderers;
    for (const int threads : plan.threads) {
        for (const traversal::TracerKind tracer : plan.tracers) {
            engine::RenderSettings settings = plan.render;
            settings.tracer.kind = tracer;
            renderers.push_back(std::make_unique<engine::FrameRenderer>(scene, clip, settings));
            competitors.push_back({.tracer = tracer, .threads = threads, .runs = {}});
        }
    }

    engine::Film film;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const double time_s = plan.take.rate.time_of(frames[f]);
        for (int run = -plan.warmup; run < plan.repeat; ++run) {
            for (std::size_t c = 0; c < competitors.size(); ++c) {
                tbb::task_arena arena(competitors[c].threads);
                const Report report = arena.execute([&] { return renderers[c]->render(time_s, film); });
                if (run >= 0) competitors[c].runs.push_back(report);
            }
        }
        frame_done(f + 1, frames.size());
    }
    return competitors;
}

std::string benchmark_table(std::span<const Competitor> competitors) {
    if (competitors.empty() || competitors.front().runs.empty()) return {};
    std::string text = fmt::format("{:<12} {:>7}", "median ms", "threads");
    for (const Phase& phase : phases) text += fmt::format(" {:>9}", phase.name);
    text += fmt::format(" {:>9} {:>9}\n", "primary", "shadow");
    text += fmt::format("{:<12} {:>7}{:>60} {:>9} {:>9}\n", "", "", "", "Mrays/s", "Mrays/s");
    for (const Competitor& competitor : competitors) text += row(competitor);

    const traversal::TracerKind first = competitors.front().tracer;
    for (const Competitor& ours : competitors) {
        if (ours.tracer != first) continue;
        for (const Competitor& other : competitors) {
            if (other.tracer != first && other.threads == ours.threads) text += ratios(ours, other);
        }
    }

    const Report& last = competitors.front().runs.back();
    text += fmt::format("{} triangles moving, {} still; grid {} x {} x {}, {} references, {:.1f} MB\n",
                        last.moving_triangles, last.still_triangles, last.rebuild.resolution.x,
                        last.rebuild.resolution.y, last.rebuild.resolution.z, last.rebuild.references,
                        double(last.rebuild.bytes) / 1e6);
    return text;
}

}  // namespace gridreel::sequences
