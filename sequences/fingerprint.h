#pragma once
// Fingerprints of pixels and scene files.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace gridreel::sequences {

/// SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);

/// SHA-256 of a scene: the file's bytes, and for a `.gltf` the length (64 bits, little-endian) and the
/// bytes of every file it names, in the order of `/buffers` and then `/images`. What the loader would not
/// read (a missing file, one that it may not name, a pipe) counts as empty.
/// @param asset_root  as `anim::load` takes it
/// @throws Error when the scene file itself cannot be read
[[nodiscard]] std::string scene_sha256(const std::filesystem::path& file,
                                       const std::filesystem::path& asset_root = {});

}  // namespace gridreel::sequences
