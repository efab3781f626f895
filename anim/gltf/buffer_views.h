#pragma once
// The bytes of buffer views (glTF 2.0, section 3.6.1), compressed or not.

#include "anim/gltf/budget.h"
#include "anim/gltf/place.h"
#include "anim/scene.h"

#include <cstddef>
#include <span>
#include <vector>

namespace gridreel::anim::gltf {

/// Moving keeps `bytes` valid, copying does not.
struct BufferViews {
    std::vector<std::span<const std::byte>> bytes;     ///< one for each view of the file
    std::vector<std::vector<std::byte>> decompressed;  ///< what some of `bytes` refer to
    std::vector<Warning> warnings;                     ///< of copies used instead of compressed data
};

/// Whether a buffer only stands in for compressed views, and so may have no bytes.
[[nodiscard]] bool is_fallback(const Place& buffer);

/// Finds the bytes of every buffer view, whether something reads it or not. Views that are compressed by
/// EXT_meshopt_compression or KHR_meshopt_compression are decompressed; where that is not possible, but the
/// file has an uncompressed copy, the copy is used, with a warning.
///
/// @param buffers  the bytes of each buffer; empty where the file does not say where they are
/// @throws Error for views beyond their buffer, compressed views that break the rules of the extension, ask
///         for more than the budget or cannot be decompressed
[[nodiscard]] BufferViews resolve_views(const Place& root,
                                        std::span<const std::span<const std::byte>> buffers, Budget& budget);

}  // namespace gridreel::anim::gltf
