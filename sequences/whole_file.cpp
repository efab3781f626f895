#include "sequences/whole_file.h"

#include "sequences/errors.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace gridreel::sequences {
namespace {

/// @return 0, or the error number
int write_all(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) return errno;
    int error = 0;
    while (!bytes.empty() && error == 0) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            error = errno;
        }
    }
    // Some file systems only say here that the disk is full.
    if (close(descriptor) != 0 && error == 0) error = errno;
    return error;
}

}  // namespace

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

void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    const std::filesystem::path hidden =
        file.parent_path() / fmt::format(".{}.{}.part", file.filename().string(), getpid());
    std::error_code error(write_all(hidden, bytes), std::generic_category());
    if (!error) std::filesystem::rename(hidden, file, error);
    if (!error) return;

    std::error_code ignored;  // perhaps it was never made
    std::filesystem::remove(hidden, ignored);
    throw OutputError(fmt::format("the file cannot be written ({})", error.message()), file.string(),
                      "check the folder, its permissions and the free space");
}

void write_whole_file(const std::filesystem::path& file, std::string_view text) {
    write_whole_file(file, std::as_bytes(std::span(text)));
}

}  // namespace gridreel::sequences
