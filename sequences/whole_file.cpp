#include "sequences/whole_file.h"

#include "sequences/errors.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>

namespace gridreel::sequences {
namespace {

/// A new file for writing, with the permissions that the umask leaves (mkostemp's are the owner's alone).
struct HiddenFile {
    std::filesystem::path path;
    int descriptor = -1;
    int error = EEXIST;  ///< 0 when it was made
};

HiddenFile make_hidden_file(const std::filesystem::path& beside) {
    constexpr int attempts = 100;  // names of 64 random bits: the second is hardly ever needed
    std::random_device random;
    HiddenFile hidden;
    for (int i = 0; i < attempts && hidden.error == EEXIST; ++i) {
        hidden.path = beside.parent_path() /
                      fmt::format(".{}.{:08x}{:08x}.part", beside.filename().string(), random(), random());
        hidden.descriptor = open(hidden.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        hidden.error = hidden.descriptor < 0 ? errno : 0;
    }
    return hidden;
}

/// Writes and closes.
/// @return 0, or the error number
int write_all(int descriptor, std::span<const std::byte> bytes) {
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
    const HiddenFile hidden = make_hidden_file(file);
    const bool made = hidden.error == 0;
    std::error_code error(made ? write_all(hidden.descriptor, bytes) : hidden.error, std::generic_category());
    if (!error) std::filesystem::rename(hidden.path, file, error);
    if (!error) return;

    std::error_code ignored;  // the first failure is the one to report
    if (made) std::filesystem::remove(hidden.path, ignored);
    throw OutputError(fmt::format("the file cannot be written ({})", error.message()), file.string(),
                      "check the folder, its permissions and the free space");
}

void write_whole_file(const std::filesystem::path& file, std::string_view text) {
    write_whole_file(file, std::as_bytes(std::span(text)));
}

}  // namespace gridreel::sequences
