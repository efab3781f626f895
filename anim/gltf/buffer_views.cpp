#include "anim/gltf/buffer_views.h"

#include "anim/gltf/compressed_view.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace gridreel::anim::gltf {
namespace {

constexpr std::array<std::string_view, 2> extension_names{"EXT_meshopt_compression",
                                                          "KHR_meshopt_compression"};

/// What either extension says about a buffer or a view.
std::optional<Place> find_meshopt(const Place& place) {
    for (const auto name : extension_names)
        if (const auto found = place.find_extension(name)) return found;
    return {};
}

/// The bytes that a view names, or the extension object of one: they use the same properties.
std::span<const std::byte> bytes_at(const Place& place, std::span<const std::span<const std::byte>> buffers) {
    const auto buffer_index = place.at("buffer").index();
    const auto buffer = buffers[buffer_index];
    if (buffer.empty())
        place.refuse(fmt::format("buffer {} has no bytes: no URI, and no BIN chunk for it", buffer_index));

    const std::size_t offset = place.integer_or("byteOffset", 0), length = place.at("byteLength").integer();
    if (offset + length > buffer.size())
        place.refuse(fmt::format("bytes {} to {} are beyond buffer {}, which has {}", offset, offset + length,
                                 buffer_index, buffer.size()));
    return buffer.subspan(offset, length);
}

/// Whether the file has the bytes of a compressed view in the clear, too.
bool has_copy(const Place& view, std::span<const std::span<const std::byte>> buffers) {
    const std::size_t end = view.integer_or("byteOffset", 0) + view.at("byteLength").integer();
    return end <= buffers[view.at("buffer").index()].size();
}

}  // namespace

bool is_fallback(const Place& buffer) {
    const auto meshopt = find_meshopt(buffer);
    return meshopt && meshopt->boolean_or("fallback", false);
}

BufferViews resolve_views(const Place& root, std::span<const std::span<const std::byte>> buffers,
                          Budget& budget) {
    BufferViews views;
    const auto places = root.find("bufferViews");
    for (std::size_t i = 0; places && i < places->size(); ++i) {
        const Place view = (*places)[i];
        const auto meshopt = find_meshopt(view);
        if (!meshopt) {
            views.bytes.push_back(bytes_at(view, buffers));
            continue;
        }

        auto decompressed = decompress_view(view, *meshopt, bytes_at(*meshopt, buffers), budget);
        if (decompressed.refusal.empty()) {
            views.decompressed.push_back(std::move(decompressed.bytes));
            views.bytes.emplace_back(views.decompressed.back());
        } else if (has_copy(view, buffers)) {
            views.warnings.push_back(
                {.where = meshopt->pointer(),
                 .text = fmt::format("{}; the uncompressed copy is used", decompressed.refusal)});
            views.bytes.push_back(bytes_at(view, buffers));
        } else {
            meshopt->refuse(decompressed.refusal, "pack the model again, by EXT_meshopt_compression or not");
        }
    }
    return views;
}

}  // namespace gridreel::anim::gltf
