#include "tools/accel.h"

#include "sequences/errors.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <vector>

namespace gridreel::tools {

std::string accel_names() {
    std::vector<std::string_view> names;
    for (const traversal::TracerKind kind : traversal::tracer_kinds()) names.push_back(name_of(kind));
    return fmt::format("{}", fmt::join(names, ", "));
}

traversal::TracerKind read_accel(std::string_view name) {
    const std::optional<traversal::TracerKind> kind = traversal::tracer_kind(name);
    if (!kind) {
        throw sequences::UsageError(fmt::format("no structure is called '{}'", name), "--accel",
                                    fmt::format("choose from {}", accel_names()));
    }
    if (!traversal::is_built_in(*kind)) {
        throw sequences::UsageError(fmt::format("this gridreel was built without {}", name), "--accel",
                                    "install libembree-dev and build again, or choose from " + accel_names());
    }
    return *kind;
}

}  // namespace gridreel::tools
