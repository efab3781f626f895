#include "sequences/build_info.h"

#include <sys/resource.h>

#include <fstream>

namespace gridreel::sequences {

std::string_view version() {
    return GRIDREEL_VERSION;
}

std::string_view compiler() {
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (!line.starts_with("model name")) continue;
        if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

std::size_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace gridreel::sequences
