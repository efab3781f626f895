#pragma once
// glTF 2.0 in.

#include "anim/scene.h"

#include <filesystem>

namespace gridreel::anim {

/// Reads a `.gltf` (buffers beside it or embedded) or `.glb` file.
///
/// The whole file is validated before anything is built from it: every index, accessor range,
/// node tree, key order (glTF 2.0, chapter 3). URIs are honoured only inside the file's folder.
///
/// @throws Error naming the file, the JSON pointer of the defect and the remedy, for anything
///         malformed, unreadable, or listed in `extensionsRequired` and unsupported
[[nodiscard]] Scene load(const std::filesystem::path& file);

}  // namespace gridreel::anim
