#include "sequences/timing_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace gridreel::sequences {
namespace {

struct Row {
    const char* name;
    double (*value)(const FrameRecord&);
};

constexpr Row rows[]{
    {"animate", [](const FrameRecord& r) { return r.render.animate_ms; }},
    {"rebuild", [](const FrameRecord& r) { return r.render.rebuild.total_ms; }},
    {"trace", [](const FrameRecord& r) { return r.render.trace_ms; }},
    {"shade", [](const FrameRecord& r) { return r.render.shade_ms; }},
    {"write", [](const FrameRecord& r) { return r.write_ms; }},
    {"total", [](const FrameRecord& r) { return r.total_ms(); }},
};

bool chose_lambda(const FrameRecord* record) {
    return record->render.predicted.has_value();
}

}  // namespace

Spread spread_of(std::vector<double> values) {
    assert(!values.empty());
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return {.min = values.front(),
            .median = values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2.0,
            .max = values.back()};
}

double rebuild_share(const FrameRecord& record) {
    const double both = record.render.rebuild.total_ms + record.render.trace_ms;
    return both > 0.0 ? record.render.rebuild.total_ms / both : 0.0;
}

std::string timing_table(std::span<const FrameRecord> records) {
    std::vector<const FrameRecord*> written;
    for (const FrameRecord& record : records) {
        if (!record.failed()) written.push_back(&record);
    }
    if (written.empty()) return {};

    const auto spread = [&](auto value) {
        std::vector<double> values;
        for (const FrameRecord* record : written) values.push_back(value(*record));
        return spread_of(std::move(values));
    };
    std::string table = fmt::format("{:<14}{:>10}{:>10}{:>10}\n", "ms", "min", "median", "max");
    for (const Row& row : rows) {
        const Spread ms = spread(row.value);
        table += fmt::format("{:<14}{:>10.2f}{:>10.2f}{:>10.2f}\n", row.name, ms.min, ms.median, ms.max);
    }
    const Spread share = spread(rebuild_share);
    table += fmt::format("{:<14}{:>9.1f}%{:>9.1f}%{:>9.1f}%\n", "rebuild share", 100.0 * share.min,
                         100.0 * share.median, 100.0 * share.max);
    if (std::any_of(written.begin(), written.end(), chose_lambda)) {
        const Spread lambda = spread([](const FrameRecord& r) { return double(r.render.rebuild.lambda); });
        table += fmt::format("{:<14}{:>10.4g}{:>10.4g}{:>10.4g}\n", "lambda", lambda.min, lambda.median,
                             lambda.max);
    }
    return table;
}

}  // namespace gridreel::sequences
