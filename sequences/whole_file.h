#pragma once
// Files that appear whole or not at all.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace gridreel::sequences {

/// Makes `folder` and its parents; an empty path means the current folder.
/// @throws OutputError naming the folder
void make_folder(const std::filesystem::path& folder);

/// Writes `bytes` under a hidden name beside `file` and renames that, replacing what was there. Whatever
/// fails, the hidden file is removed and `file` is as before. Its name is random and it is never one that was
/// there, so that two writers of the same file, on whatever machines, never write into each other's.
/// @throws OutputError naming `file` and the system's reason
void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
void write_whole_file(const std::filesystem::path& file, std::string_view text);

}  // namespace gridreel::sequences
