#pragma once
// What this program is and what it runs on, for the log.

#include <cstddef>
#include <string>
#include <string_view>

namespace gridreel::sequences {

[[nodiscard]] std::string_view version();   ///< "0.1.0"
[[nodiscard]] std::string_view compiler();  ///< "g++ 12.2.0"
[[nodiscard]] std::string cpu_name();       ///< as the system calls it; "unknown" when it does not

/// The largest memory this process has held so far, in bytes.
[[nodiscard]] std::size_t peak_memory_bytes();

}  // namespace gridreel::sequences
