#pragma once
// glTF 2.0 in.

#include "anim/scene.h"

#include <cstddef>
#include <filesystem>
#include <span>

namespace gridreel::anim {

/// Reads a `.gltf` (buffers beside it or embedded) or `.glb` file.
///
/// Every index, type, count, accessor range, node tree, key time and value of the core specification is
/// checked (glTF 2.0, chapter 3); a scene comes back only when the whole file is sound. Memory is bounded by
/// 512 MiB plus 128 times the bytes read.
///
/// @param asset_root  URIs may lead into the file's folder and into this one, and nowhere else; empty: into
///                    the file's folder alone
/// @throws Error naming the file, the JSON pointer of the defect and the remedy, for anything
///         malformed, unreadable, or listed in `extensionsRequired` and unsupported
[[nodiscard]] Scene load(const std::filesystem::path& file, const std::filesystem::path& asset_root = {});

/// The same for a file whose bytes are at hand.
///
/// @param file  its name, for messages and for finding the files beside it
[[nodiscard]] Scene load_bytes(std::span<const std::byte> bytes, const std::filesystem::path& file,
                               const std::filesystem::path& asset_root = {});

}  // namespace gridreel::anim
