#include "tools/competitors.h"

#include "sequences/errors.h"
#include "tools/accel.h"
#include "tools/picture_options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace gridreel::tools {
namespace {

using sequences::NamedTracer;
using sequences::UsageError;
using traversal::EmbreeQuality;
using traversal::EmbreeRays;
using traversal::TracerKind;

/// "grid", "grid:0.5", "grid:packet=8", "grid:0.5,still=unknown,packet=8": what there are several of.
std::string grid_name(const std::string& accel, const std::vector<std::string>& varied) {
    std::string name = accel;
    for (const std::string& choice : varied) {
        if (!choice.empty()) name += (name == accel ? ":" : ",") + choice;
    }
    return name;
}

/// The grid, by packets or ray by ray, with every λ and in every way asked for.
std::vector<NamedTracer> read_grids(const CompetitorText& text, const std::string& accel,
                                    traversal::TracerOptions options) {
    const auto packets =
        options.kind == TracerKind::grid ? read_packets(text.paper) : std::vector<LabelledPackets>(1);
    std::vector<NamedTracer> tracers;
    for (const std::string& lambda : text.lambdas) {
        set_lambda(lambda, options);
        for (const std::string& still : text.still) {
            options.resolution.heed_still = still == "known";
            for (const LabelledPackets& choice : packets) {
                options.packets = choice.options;
                const std::string name =
                    grid_name(accel, {text.lambdas.size() > 1 ? lambda : "",
                                      text.still.size() > 1 ? "still=" + still : "", choice.label});
                tracers.push_back({.name = name, .options = options});
            }
        }
    }
    return tracers;
}

/// Embree in every quality asked for.
std::vector<NamedTracer> read_embrees(const CompetitorText& text, const std::string& accel,
                                      traversal::TracerOptions options) {
    const std::map<std::string, EmbreeQuality> qualities{
        {"low", EmbreeQuality::low}, {"medium", EmbreeQuality::medium}, {"refit", EmbreeQuality::refit}};
    const std::map<std::string, EmbreeRays> rays{{"auto", EmbreeRays::automatic},
                                                 {"packets", EmbreeRays::packets},
                                                 {"sorted", EmbreeRays::sorted},
                                                 {"single", EmbreeRays::single}};
    std::vector<NamedTracer> tracers;
    for (const std::string& quality : text.embree_qualities) {
        options.embree = {.quality = qualities.at(quality), .rays = rays.at(text.embree_rays)};
        tracers.push_back(
            {.name = quality == "low" ? accel : fmt::format("{}-{}", accel, quality), .options = options});
    }
    return tracers;
}

/// @throws UsageError for options of packets where no structure has any
void check_paper_options(const PaperText& paper, const std::vector<NamedTracer>& tracers) {
    const std::string option = first_written(paper);
    const bool has_packets = std::any_of(tracers.begin(), tracers.end(), [](const NamedTracer& tracer) {
        return tracer.options.kind == TracerKind::grid;
    });
    if (!option.empty() && !has_packets) {
        throw UsageError("no structure that is compared traces packets of the grid", option,
                         "add grid to --accel");
    }
}

}  // namespace

void add_competitor_options(CLI::App& app, CompetitorText& text) {
    const char* const group = "What to compare";
    app.add_option("--accel", text.accels,
                   fmt::format("Structures: {}; the first is compared with the others", accel_names()))
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("LIST")
        ->default_str("grid")
        ->group(group);
    app.add_option(
           "--lambda", text.lambdas,
           "Grid cells per triangle: numbers, paper (5), auto (by cost, settled in the warm-up); several: a "
           "grid for each")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("LIST")
        ->default_str("auto")
        ->group(group);
    app.add_option("--still", text.still,
                   "Whether grids know which triangles never move, and keep their lists: known, unknown; "
                   "several: a grid for each")
        ->check(CLI::IsMember({"known", "unknown"}).description(""))
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("LIST")
        ->default_str("known")
        ->group(group);
    app.add_option("--embree-quality", text.embree_qualities,
                   "Embree's hierarchy: low and medium are built every frame, refit at the clip's start; "
                   "several: each")
        ->check(CLI::IsMember({"low", "medium", "refit"}).description(""))
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("LIST")
        ->default_str("low")
        ->group(group);
    app.add_option(
           "--embree-rays", text.embree_rays,
           "Rays for Embree: packets of 16, sorted first, single, or auto: each, and the quickest counts")
        ->check(CLI::IsMember({"auto", "packets", "sorted", "single"}).description(""))
        ->type_name("auto|packets|sorted|single")
        ->capture_default_str()
        ->group(group);
    add_paper_options(app, text.paper);
}

std::vector<NamedTracer> read_competitors(const CompetitorText& text, const traversal::TracerOptions& basis) {
    std::vector<NamedTracer> tracers;
    const auto add = [&](std::vector<NamedTracer> more) {
        std::move(more.begin(), more.end(), std::back_inserter(tracers));
    };
    for (const std::string& accel : text.accels) {
        traversal::TracerOptions options = basis;
        options.kind = read_accel(accel);
        if (options.kind == TracerKind::naive) {
            add({{.name = accel, .options = options}});
        } else if (options.kind == TracerKind::embree) {
            add(read_embrees(text, accel, options));
        } else {
            add(read_grids(text, accel, options));
        }
    }
    check_paper_options(text.paper, tracers);

    std::set<std::string> names;
    for (const NamedTracer& tracer : tracers) {
        if (!names.insert(tracer.name).second) {
            throw UsageError(fmt::format("{} is to be compared with itself", tracer.name), "--accel",
                             "name everything once");
        }
    }
    return tracers;
}

}  // namespace gridreel::tools
