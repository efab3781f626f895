#pragma once
// Telling the two containers apart: plain JSON and binary glTF.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace gridreel::anim::gltf {

/// The parts of a file; both refer to its bytes.
struct Container {
    std::string_view json{};
    std::span<const std::byte> binary{};  ///< the BIN chunk; empty when there is none
    bool is_binary = false;               ///< a `.glb`, whatever the file's name
    std::size_t trailing_bytes = 0;       ///< after the length that a GLB header states
};

/// Splits a file into its chunks (glTF 2.0, chapter 4). Anything without the magic is taken for JSON.
///
/// @throws Error when header or chunk lengths do not fit the bytes there are
[[nodiscard]] Container split_container(std::span<const std::byte> bytes, const std::string& file);

}  // namespace gridreel::anim::gltf
