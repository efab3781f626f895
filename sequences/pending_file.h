#pragma once
// Files that appear whole or not at all.

#include <filesystem>

namespace gridreel::sequences {

/// Makes `folder` and its parents; an empty path means the current folder.
/// @throws OutputError naming the folder
void make_folder(const std::filesystem::path& folder);

/// A file in the making: written under a hidden name beside its final one, put in place by `commit`.
/// Without `commit` the destructor removes it. The name holds the process id, so that two processes
/// writing the same file never write into each other's.
class PendingFile {
public:
    explicit PendingFile(std::filesystem::path target);
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;
    ~PendingFile();

    [[nodiscard]] const std::filesystem::path& target() const { return target_; }
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }

    /// Renames the finished file to its final name, replacing what was there.
    /// @throws OutputError naming the final file
    void commit();

private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;
};

}  // namespace gridreel::sequences
