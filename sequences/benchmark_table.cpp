#include "sequences/benchmark_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gridreel::sequences {
namespace {

constexpr std::array ray_phases{"primary", "shadow", "bounce"};

std::string_view plural(std::size_t count) {
    return count == 1 ? "" : "s";
}

/// Ratios far below 1 with a digit more.
std::string times_faster(double speedup) {
    return speedup < 0.1 ? fmt::format("{:.3f}", speedup) : fmt::format("{:.2f}", speedup);
}

bool has_rays(std::string_view phase) {
    return std::find(ray_phases.begin(), ray_phases.end(), phase) != ray_phases.end();
}

/// How wide the first column is.
std::size_t name_width(const SceneFigures& figures) {
    std::size_t width = 22;
    for (const CompetitorFigures& competitor : figures.competitors)
        width = std::max(width, competitor.name.size() + 1);
    return width;
}

std::string heading(const CompetitorFigures& any, std::size_t width) {
    std::string text = fmt::format("{:<{}}{:>7}  {:<6}", "ms", width, "threads", "");
    for (const PhaseFigures& phase : any.phases) text += fmt::format(" {:>9}", phase.name);
    text += "  |";
    for (const PhaseFigures& phase : any.phases) {
        if (has_rays(phase.name)) text += fmt::format(" {:>8}", phase.name);
    }
    return text + " Mrays/s\n";
}

std::string times(const CompetitorFigures& competitor, std::size_t width) {
    std::string text =
        fmt::format("{:<{}}{:>7}  {:<6}", competitor.name, width, competitor.threads, "median");
    for (const PhaseFigures& phase : competitor.phases) text += fmt::format(" {:>9.2f}", phase.median_ms);
    text += "  |";
    for (const PhaseFigures& phase : competitor.phases) {
        if (has_rays(phase.name)) text += fmt::format(" {:>8.2f}", phase.rays_per_second / 1e6);
    }
    text += fmt::format("\n{:<{}}{:<6}", "", width + 9, "min");
    for (const PhaseFigures& phase : competitor.phases) text += fmt::format(" {:>9.2f}", phase.min_ms);
    text += fmt::format("\n{:<{}}{:<6}", "", width + 9, "p95");
    for (const PhaseFigures& phase : competitor.phases) text += fmt::format(" {:>9.2f}", phase.p95_ms);
    return text + "\n";
}

std::string structure(const CompetitorFigures& competitor) {
    std::string text =
        fmt::format("{}, {} thread{}: {:.1f} bytes a triangle", competitor.name, competitor.threads,
                    plural(static_cast<std::size_t>(competitor.threads)), competitor.bytes_per_triangle);
    if (competitor.rebuild_share > 0.0) {
        text += fmt::format(", rebuild {:.1f}% of the frame", 100.0 * competitor.rebuild_share);
    }
    if (competitor.cells > 0) {
        text += fmt::format(", lambda {:g}, {} x {} x {}, {} cells, {} references", competitor.lambda,
                            competitor.resolution.x, competitor.resolution.y, competitor.resolution.z,
                            competitor.cells, competitor.references);
    }
    for (const PhaseFigures& phase : competitor.phases) {
        if (phase.cells_per_ray > 0.0 || phase.tests_per_ray > 0.0) {
            text += fmt::format(", {}: {:.2f} cells and {:.2f} tests a ray", phase.name, phase.cells_per_ray,
                                phase.tests_per_ray);
        }
        if (phase.extra_bytes_per_triangle > 0.0) {
            text += fmt::format(", with {:.1f} more bytes a triangle", phase.extra_bytes_per_triangle);
        }
        if (!phase.way.empty()) text += fmt::format(", {} rays: {}", phase.name, phase.way);
    }
    return text + "\n";
}

std::string ratio_lines(const SceneFigures& figures) {
    std::string text;
    const Ratio* last = nullptr;
    for (const Ratio& ratio : figures.ratios) {
        if (!last || last->against != ratio.against || last->threads != ratio.threads) {
            if (last) text += "\n";
            text +=
                fmt::format("{} against {}, {} thread{}:", figures.competitors.front().name, ratio.against,
                            ratio.threads, plural(static_cast<std::size_t>(ratio.threads)));
        }
        text += fmt::format(" {} {}x", ratio.phase, times_faster(ratio.speedup));
        last = &ratio;
    }
    return last ? text + "\n" : text;
}

/// A file's name must not end a cell or a row.
std::string cell(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '|') safe += '\\';
        safe += c == '\n' || c == '\r' ? ' ' : c;
    }
    return safe;
}

}  // namespace

std::string benchmark_table(const SceneFigures& figures) {
    if (figures.competitors.empty()) return {};
    std::string text =
        fmt::format("{}: {} triangles moving, {} still; {} frame{}, {} runs of each competitor\n",
                    figures.scene, figures.moving_triangles, figures.still_triangles, figures.frames,
                    plural(figures.frames), figures.runs);
    const std::size_t width = name_width(figures);
    text += heading(figures.competitors.front(), width);
    for (const CompetitorFigures& competitor : figures.competitors) text += times(competitor, width);
    for (const CompetitorFigures& competitor : figures.competitors) text += structure(competitor);
    return text + ratio_lines(figures);
}

std::string markdown_table(std::span<const SceneFigures> scenes) {
    // Columns in the order in which they first come up.
    using Column = std::pair<std::string, std::string>;  // against, phase
    std::vector<Column> columns;
    for (const SceneFigures& scene : scenes) {
        for (const Ratio& ratio : scene.ratios) {
            const Column column{ratio.against, ratio.phase};
            if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
        }
    }

    std::string text = "| scene | triangles | threads |";
    for (const auto& [against, phase] : columns) text += fmt::format(" {}, {} |", phase, cell(against));
    text += "\n|---|--:|--:|";
    for (std::size_t i = 0; i < columns.size(); ++i) text += "--:|";
    text += "\n";
    for (const SceneFigures& scene : scenes) {
        std::vector<int> threads;
        for (const CompetitorFigures& competitor : scene.competitors) {
            if (std::find(threads.begin(), threads.end(), competitor.threads) == threads.end())
                threads.push_back(competitor.threads);
        }
        for (const int count : threads) {
            text += fmt::format("| {} | {} | {} |", cell(scene.scene),
                                scene.moving_triangles + scene.still_triangles, count);
            for (const Column& column : columns) {
                const auto found =
                    std::find_if(scene.ratios.begin(), scene.ratios.end(), [&](const Ratio& ratio) {
                        return ratio.threads == count && Column{ratio.against, ratio.phase} == column;
                    });
                text +=
                    found == scene.ratios.end() ? " |" : fmt::format(" {} |", times_faster(found->speedup));
            }
            text += "\n";
        }
    }
    return text;
}

}  // namespace gridreel::sequences
