#pragma once
// Where a URI of the file leads: embedded bytes, or a file in folders that it may name, and nowhere else.

#include "anim/gltf/place.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gridreel::anim::gltf {

/// A `data:` URI taken apart (RFC 2397).
struct DataUri {
    std::string_view mime_type;  ///< may be empty; refers to the URI
    std::vector<std::byte> bytes{};
};

/// The bytes of a `data:` URI, base64 or percent-encoded; absent when the URI has another form.
///
/// @throws Error at `place` for a `data:` URI that is neither
[[nodiscard]] std::optional<DataUri> decode_data_uri(std::string_view uri, const Place& place);

/// Where a relative URI leads: a path, or the reason why it is not followed.
struct UriTarget {
    std::filesystem::path path{};
    std::string refusal{};  ///< empty: `path` may be read
    std::string remedy{};
};

/// Follows a relative, percent-encoded URI. Schemes, absolute paths and paths that lead elsewhere than into
/// the two folders are refused, through symbolic links too.
///
/// @param folder      the folder of the glTF file, from which the URI starts
/// @param asset_root  another folder whose files it may name; empty: none
[[nodiscard]] UriTarget resolve_uri(std::string_view uri, const std::filesystem::path& folder,
                                    const std::filesystem::path& asset_root);

}  // namespace gridreel::anim::gltf
