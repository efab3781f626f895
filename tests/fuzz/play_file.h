#pragma once
// A file's whole way through anim, as `render` takes it: what the fuzzer and the test of its corpus run.

#include <cstddef>
#include <filesystem>
#include <span>

namespace gridreel::test {

enum class Played { refused, too_large, whole };

/// Loads the bytes, then lays out, poses and deforms the clip "auto" of every scene at a few times.
///
/// Anything but success and `gridreel::Error` is a defect: other exceptions pass through, and a vertex
/// that is out of range, or a message that lacks what users need, ends the program.
///
/// @param empty_folder  where the files beside the model would be: empty, or not there at all
/// @return `refused` for an Error, `too_large` when frames were skipped to keep a run short
Played play_file(std::span<const std::byte> bytes, const std::filesystem::path& empty_folder);

}  // namespace gridreel::test
