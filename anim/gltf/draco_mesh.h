#pragma once
// Decoding one Draco stream (bitstream 2.2, https://google.github.io/draco/spec/).

#include "anim/gltf/accessor.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gridreel::anim::gltf {

/// One attribute as its reader wants it.
struct DracoAttribute {
    std::string name;             ///< for messages
    std::uint32_t unique_id = 0;  ///< in the stream
    ComponentType component = ComponentType::float32;
    std::uint32_t components = 1;  ///< 1 to 4
};

/// What a stream must hold, and what decoding it may cost.
struct DracoRequest {
    std::size_t points = 0;
    std::optional<std::size_t> triangles{};  ///< absent: any number
    std::vector<DracoAttribute> attributes{};
    std::size_t most_bytes = 0;  ///< of memory, for the decoder's own tables and the result together
};

/// A mesh, or the reason why there is none.
struct DracoMesh {
    std::vector<std::uint32_t> indices{};  ///< three for each triangle, below the number of points
    std::vector<std::vector<std::byte>> attributes{};  ///< those requested, in order, tightly packed
    std::string refusal{};                             ///< empty: the mesh is as requested
};

/// Decodes a triangle mesh, sequential or edgebreaker. Integers are converted where every value fits.
///
/// Counts that the stream claims are compared with the request before memory is allocated for them.
[[nodiscard]] DracoMesh decode_draco(std::span<const std::byte> encoded, const DracoRequest& request);

}  // namespace gridreel::anim::gltf
