#pragma once
// Decompressing one buffer view (EXT_meshopt_compression and KHR_meshopt_compression).

#include "anim/gltf/budget.h"
#include "anim/gltf/place.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace gridreel::anim::gltf {

/// A view's bytes, or the reason why there are none.
struct DecompressedView {
    std::vector<std::byte> bytes{};  ///< as many as the view states
    std::string refusal{};           ///< empty: `bytes` are the view's
};

/// Decompresses what the extension object of a buffer view describes. Of the younger KHR_meshopt_compression,
/// attributes of version 1 and the filter COLOR are not understood; the refusal says so.
///
/// Indices may come out of range when the data is damaged: whoever reads them checks.
///
/// @param view     the buffer view, whose length and stride must agree with the extension
/// @param meshopt  its extension object; both of a validated shape
/// @param encoded  the bytes that the extension names
/// @throws Error for what the extension forbids, and when the budget does not allow it
[[nodiscard]] DecompressedView decompress_view(const Place& view, const Place& meshopt,
                                               std::span<const std::byte> encoded, Budget& budget);

}  // namespace gridreel::anim::gltf
