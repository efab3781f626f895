// libFuzzer's way in: any bytes are a file.

#include "tests/fuzz/mutate_file.h"
#include "tests/fuzz/play_file.h"

#include <tbb/global_control.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

/// An empty folder, so that no URI of a made-up file leads to a real one.
std::filesystem::path make_empty_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "gridreel-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    return name;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // One thread: a finding must come back when its bytes do.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    static const std::filesystem::path folder = make_empty_folder();
    static_cast<void>(gridreel::test::play_file({reinterpret_cast<const std::byte*>(data), size}, folder));
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
    return gridreel::test::mutate_file(
        {reinterpret_cast<std::byte*>(data), max_size}, size, seed,
        [](std::span<std::byte> room, std::size_t used) {
            return LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(room.data()), used, room.size());
        });
}
