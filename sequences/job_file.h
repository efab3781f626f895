#pragma once
// Job files: the part of TOML 1.0 that options need.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gridreel::sequences {

/// One `key = value` under its `[section]`.
struct JobFileEntry {
    std::string section;  ///< empty before the first `[section]`
    std::string key;
    std::vector<std::string> values;  ///< one, or an array's; strings without quotes and escapes
    std::size_t line = 0;             ///< from 1
};

/// Reads sections, bare or quoted keys, strings of one line, numbers, booleans and arrays of these.
///
/// @param name  of the file, for messages
/// @throws UsageError with file and line for everything else TOML has (tables in values, dotted keys,
///         dates, multi-line strings), for anything malformed, and for a key given twice
[[nodiscard]] std::vector<JobFileEntry> parse_job_file(std::string_view text, std::string_view name);

/// The same from disk.
[[nodiscard]] std::vector<JobFileEntry> read_job_file(const std::filesystem::path& file);

}  // namespace gridreel::sequences
