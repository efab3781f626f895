#pragma once
// Changing a glTF file so that it mostly stays one: random bytes rarely get past the JSON parser and never
// keep the lengths of a binary glTF right.

#include <cstddef>
#include <functional>
#include <span>

namespace gridreel::test {

/// Changes the first `used` bytes of `room` into at most as many as fit; their number afterwards.
using MutateBytes = std::function<std::size_t(std::span<std::byte> room, std::size_t used)>;

/// Changes a file in one of three ways, by chance: a value of its JSON for another, the bytes of its BIN
/// chunk, or any bytes at all. Lengths are put right after the first two.
///
/// @param room    the file's bytes, then spare room
/// @param used    how many of them are the file
/// @param seed    decides everything; the same for the same result
/// @param mutate  how bytes are changed
/// @return the size of the changed file, at most that of `room`
std::size_t mutate_file(std::span<std::byte> room, std::size_t used, unsigned seed,
                        const MutateBytes& mutate);

}  // namespace gridreel::test
