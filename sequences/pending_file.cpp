#include "sequences/pending_file.h"

#include "sequences/errors.h"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>
#include <utility>

namespace gridreel::sequences {

void make_folder(const std::filesystem::path& folder) {
    if (folder.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (!error && !std::filesystem::is_directory(folder, error)) {
        error = std::make_error_code(std::errc::not_a_directory);
    }
    if (error) {
        throw OutputError(fmt::format("the folder cannot be made ({})", error.message()), folder.string(),
                          "choose another with --output");
    }
}

PendingFile::PendingFile(std::filesystem::path target)
    : target_(std::move(target)),
      temporary_(target_.parent_path() / fmt::format(".{}.{}.part", target_.filename().string(), getpid())) {}

PendingFile::~PendingFile() {
    std::error_code ignored;  // after `commit` there is nothing left to remove
    std::filesystem::remove(temporary_, ignored);
}

void PendingFile::commit() {
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) {
        throw OutputError(fmt::format("the finished file cannot be put in place ({})", error.message()),
                          target_.string(), "check the folder");
    }
}

}  // namespace gridreel::sequences
