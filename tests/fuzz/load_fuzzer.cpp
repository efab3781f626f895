// libFuzzer's way in: any bytes are a file.

#include "tests/fuzz/mutate_file.h"
#include "tests/fuzz/play_file.h"

#include <tbb/global_control.h>

#include <cstddef>
#include <cstdint>
#include <span>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // One thread: a finding must come back when its bytes do.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    // Where there is no folder, no URI of a made-up file leads to a real one.
    constexpr auto nowhere = "/nonexistent";
    static_cast<void>(gridreel::test::play_file({reinterpret_cast<const std::byte*>(data), size}, nowhere));
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
