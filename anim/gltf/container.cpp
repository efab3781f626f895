#include "anim/gltf/container.h"

#include "anim/error.h"

#include <fmt/format.h>

#include <cstdint>

namespace gridreel::anim::gltf {
namespace {

constexpr std::uint32_t magic_gltf = 0x46546C67;
constexpr std::uint32_t chunk_json = 0x4E4F534A;
constexpr std::uint32_t chunk_bin = 0x004E4942;
constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr auto truncated = "the file is cut short or damaged: fetch or export it again";

/// Little-endian; `offset + 4` is within `bytes`.
std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return value;
}

}  // namespace

Container split_container(std::span<const std::byte> bytes, const std::string& file) {
    if (bytes.empty()) throw Error("the file is empty", file, "export it again");

    const bool is_binary = bytes.size() >= 4 && word(bytes, 0) == magic_gltf;
    if (!is_binary) return {.json = {reinterpret_cast<const char*>(bytes.data()), bytes.size()}};

    // Header.
    if (bytes.size() < header_bytes + chunk_header_bytes)
        throw Error("the binary glTF ends inside its header", file, truncated);
    const std::uint32_t version = word(bytes, 4), length = word(bytes, 8);
    if (version != 2)
        throw Error(fmt::format("the container is binary glTF version {}, not 2", version), file,
                    "export the model as glTF 2.0");
    if (length > bytes.size())
        throw Error(fmt::format("the header states {} bytes but the file has {}", length, bytes.size()), file,
                    truncated);
    if (length < header_bytes + chunk_header_bytes)
        throw Error(fmt::format("the header states {} bytes, less than a header and a chunk", length), file,
                    truncated);

    // Chunks: JSON first, BIN second; the rest belongs to extensions.
    Container parts{.is_binary = true, .trailing_bytes = bytes.size() - length};
    const auto body = bytes.first(length);
    std::size_t offset = header_bytes;
    for (std::size_t chunk = 0; chunk < 2 && body.size() - offset >= chunk_header_bytes; ++chunk) {
        const std::uint32_t chunk_length = word(body, offset), type = word(body, offset + 4);
        offset += chunk_header_bytes;
        if (chunk_length > body.size() - offset)
            throw Error(fmt::format("chunk {} states {} bytes but {} are left", chunk, chunk_length,
                                    body.size() - offset),
                        file, truncated);
        const auto data = body.subspan(offset, chunk_length);
        offset += chunk_length;
        if (chunk == 0) {
            if (type != chunk_json) throw Error("the first chunk is not JSON", file, truncated);
            parts.json = {reinterpret_cast<const char*>(data.data()), data.size()};
        } else if (type == chunk_bin) {
            parts.binary = data;
        }
    }
    return parts;
}

}  // namespace gridreel::anim::gltf
