#pragma once
// The structures that `gridreel bench` sets side by side.

#include "sequences/benchmark.h"
#include "tools/paper_options.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace gridreel::tools {

/// Options as written.
struct CompetitorText {
    std::vector<std::string> accels{"grid"};
    std::vector<std::string> lambdas{"auto"};
    std::vector<std::string> still{"known"};
    PaperText paper;
    std::vector<std::string> embree_qualities{"low"};
    std::string embree_rays = "auto";
};

/// --accel --lambda --still --embree-quality --embree-rays, and those of `add_paper_options`.
void add_competitor_options(CLI::App& app, CompetitorText& text);

/// Every structure with every choice that there is for it, each under a name of its own.
/// @param basis  what all have in common
/// @throws sequences::UsageError
[[nodiscard]] std::vector<sequences::NamedTracer> read_competitors(const CompetitorText& text,
                                                                   const traversal::TracerOptions& basis);

}  // namespace gridreel::tools
