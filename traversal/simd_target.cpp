#include "traversal/simd_target.h"

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>

namespace gridreel::traversal {
namespace {

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

/// Lower bits are better instruction sets.
std::vector<std::int64_t> usable_targets() {
    std::vector<std::int64_t> targets;
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
        targets.push_back(rest & -rest);
    }
    return targets;
}

void use(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

std::vector<std::string_view> simd_targets() {
    std::vector<std::string_view> names;
    for (const std::int64_t target : usable_targets()) names.emplace_back(hwy::TargetName(target));
    return names;
}

std::string_view simd_target() {
    return hwy::TargetName(usable_targets().front());
}

bool limit_simd_target(std::string_view name) {
    if (name.empty()) {
        use(0);
        return true;
    }
    const std::string wanted = lower_case(name) == "avx512" ? "avx3" : lower_case(name);
    const std::int64_t limited_before = hwy::SupportedTargets();
    use(0);
    const std::vector<std::int64_t> all = usable_targets();
    const auto found = std::find_if(all.begin(), all.end(), [&](std::int64_t target) {
        return lower_case(hwy::TargetName(target)) == wanted;
    });
    if (found == all.end()) {
        use(limited_before);
        return false;
    }
    std::int64_t allowed = 0;
    for (auto target = found; target != all.end(); ++target) allowed |= *target;
    use(allowed);
    return true;
}

}  // namespace gridreel::traversal
