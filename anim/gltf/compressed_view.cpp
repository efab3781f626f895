#include "anim/gltf/compressed_view.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <string>
#include <string_view>
#include <utility>

namespace gridreel::anim::gltf {
namespace {

/// Nothing that is encoded shrinks further: attributes that never change still take 2 bits for 16 bytes,
/// triangles take a byte for 12 and indices a byte for 4.
constexpr std::size_t most_expansion = 64;

/// The first byte of attributes: the codec in the upper half, its version in the lower.
constexpr unsigned attributes_of_version_1 = 0xa1;

struct Stream {
    std::string_view mode, filter;
    std::size_t count = 0, stride = 0;
};

/// The list of "Specifying compressed views" in the extension's text.
void check_rules(const Place& view, const Place& meshopt, const Stream& stream) {
    const auto& [mode, filter, count, stride] = stream;
    const Place stride_place = meshopt.at("byteStride");
    if (mode == "ATTRIBUTES") {
        if (stride % 4 != 0)
            stride_place.refuse(fmt::format("attributes are {} bytes; they must be a multiple of 4", stride));
    } else {
        if (stride != 2 && stride != 4)
            stride_place.refuse(fmt::format("indices are {} bytes; they must be 2 or 4", stride));
        if (filter != "NONE")
            meshopt.at("filter").refuse(
                fmt::format("the filter {} is for attributes, not for {}", filter, mode));
        if (mode == "TRIANGLES" && count % 3 != 0)
            meshopt.at("count").refuse(fmt::format("{} indices do not make whole triangles", count));
    }

    if ((filter == "OCTAHEDRAL" || filter == "COLOR") && stride != 4 && stride != 8)
        stride_place.refuse(fmt::format("the filter {} needs 4 or 8 bytes, not {}", filter, stride));
    if (filter == "QUATERNION" && stride != 8)
        stride_place.refuse(fmt::format("the filter QUATERNION needs 8 bytes, not {}", stride));

    const Place length = view.at("byteLength");
    if (length.integer() != count * stride)
        length.refuse(fmt::format("the view has {} bytes, but {} elements of {} bytes are compressed",
                                  length.integer(), count, stride));
    // The younger extension leaves this to the accessors.
    if (const auto own = view.find("byteStride");
        own && own->integer() != stride && meshopt.pointer().ends_with("/EXT_meshopt_compression"))
        own->refuse(fmt::format("the view's stride is {}, but {} in its extension", own->integer(), stride));
}

/// Why the library at hand cannot read this; empty when it can.
std::string unsupported(const Stream& stream, std::span<const std::byte> encoded) {
    if (stream.filter == "COLOR") return "the filter COLOR is not supported";
    if (stream.mode == "ATTRIBUTES" && std::to_integer<unsigned>(encoded[0]) == attributes_of_version_1)
        return "attributes of version 1 are not supported";
    if (stream.count * stream.stride > most_expansion * encoded.size())
        return fmt::format("{} compressed bytes cannot hold {} elements of {} bytes", encoded.size(),
                           stream.count, stream.stride);
    return {};
}

bool decode(const Stream& stream, std::span<const std::byte> encoded, std::span<std::byte> bytes) {
    const auto* const source = reinterpret_cast<const unsigned char*>(encoded.data());
    const std::size_t size = encoded.size();
    if (stream.mode == "ATTRIBUTES")
        return meshopt_decodeVertexBuffer(bytes.data(), stream.count, stream.stride, source, size) == 0;
    void* const indices = bytes.data();  // the size of an index is then that of the stream
    if (stream.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(indices, stream.count, stream.stride, source, size) == 0;
    return meshopt_decodeIndexSequence(indices, stream.count, stream.stride, source, size) == 0;
}

void apply_filter(const Stream& stream, std::span<std::byte> bytes) {
    if (stream.filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(bytes.data(), stream.count, stream.stride);
    else if (stream.filter == "QUATERNION")
        meshopt_decodeFilterQuat(bytes.data(), stream.count, stream.stride);
    else if (stream.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(bytes.data(), stream.count, stream.stride);
}

}  // namespace

DecompressedView decompress_view(const Place& view, const Place& meshopt, std::span<const std::byte> encoded,
                                 Budget& budget) {
    const std::string mode = meshopt.at("mode").text(), filter = meshopt.text_or("filter", "NONE");
    const Stream stream{.mode = mode,
                        .filter = filter,
                        .count = meshopt.at("count").integer(),
                        .stride = meshopt.at("byteStride").integer()};
    check_rules(view, meshopt, stream);
    if (auto reason = unsupported(stream, encoded); !reason.empty()) return {.refusal = std::move(reason)};

    DecompressedView result;
    budget.spend(stream.count * stream.stride, meshopt);
    result.bytes.resize(stream.count * stream.stride);
    if (!decode(stream, encoded, result.bytes)) return {.refusal = "the compressed data is damaged"};
    apply_filter(stream, result.bytes);
    return result;
}

}  // namespace gridreel::anim::gltf
