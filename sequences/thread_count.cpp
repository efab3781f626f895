#include "sequences/thread_count.h"

#include "anim/parse_number.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>

namespace gridreel::sequences {
namespace {

std::string first_line(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

int processors_in_mask() {
    cpu_set_t mask;
    CPU_ZERO(&mask);
    if (sched_getaffinity(0, sizeof mask, &mask) == 0) return CPU_COUNT(&mask);
    // More processors than the mask has bits.
    return static_cast<int>(std::thread::hardware_concurrency());
}

/// The tightest quota of this process's control group and those around it.
std::optional<int> group_quota() {
    std::optional<int> tightest;
    const auto consider = [&](std::optional<int> quota) {
        if (quota && (!tightest || *quota < *tightest)) tightest = quota;
    };

    // Version 2: "0::/a/b" names the group; every ancestor limits too.
    const std::filesystem::path root = "/sys/fs/cgroup";
    std::ifstream membership("/proc/self/cgroup");
    for (std::string line; std::getline(membership, line);) {
        if (!line.starts_with("0::/")) continue;
        std::filesystem::path group = root / line.substr(4);
        for (; group != root && group.has_relative_path(); group = group.parent_path()) {
            consider(cpu_quota(first_line(group / "cpu.max")));
        }
    }
    consider(cpu_quota(first_line(root / "cpu.max")));

    // Version 1 splits the same two numbers over two files, -1 for no limit.
    const std::filesystem::path version_1 = root / "cpu";
    consider(cpu_quota(first_line(version_1 / "cpu.cfs_quota_us") + " " +
                       first_line(version_1 / "cpu.cfs_period_us")));
    return tightest;
}

}  // namespace

std::optional<int> cpu_quota(std::string_view cpu_max) {
    const std::size_t space = cpu_max.find(' ');
    if (space == std::string_view::npos) return std::nullopt;
    const auto quota = parse_number<double>(cpu_max.substr(0, space));
    const auto period = parse_number<double>(cpu_max.substr(space + 1));
    if (!quota || !period || !(*quota > 0.0) || !(*period > 0.0)) return std::nullopt;
    return static_cast<int>(std::clamp(std::ceil(*quota / *period), 1.0, 1e6));
}

int allowed_threads() {
    const int processors = std::max(processors_in_mask(), 1);
    return std::min(processors, group_quota().value_or(processors));
}

}  // namespace gridreel::sequences
