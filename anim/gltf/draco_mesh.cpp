#include "anim/gltf/draco_mesh.h"

#include <draco/draco_features.h>

// What is defined above decides what these declare.
#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_tex_coords_decoder.h>
#include <draco/compression/attributes/prediction_schemes/mesh_prediction_scheme_tex_coords_portable_decoder.h>
#include <draco/compression/attributes/prediction_schemes/prediction_scheme_wrap_decoding_transform.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <exception>
#include <type_traits>

// Draco 1.5.5 believes how many orientations its two predictions of texture coordinates claim: up to 2^32, in
// seconds and half a gigabyte, from a few hundred bytes. Nothing that may be overridden lies in between, so
// these functions take the place of the library's own, which are weak symbols of its archive; a test fails
// where they do not.
namespace draco {

using WrapTransform = PredictionSchemeWrapDecodingTransform<int, int>;
using BaseMesh = MeshPredictionSchemeData<CornerTable>;
using SeamedMesh = MeshPredictionSchemeData<MeshAttributeCornerTable>;

/// `resize(n)` makes room for the orientations, `set(i, orientation)` keeps one.
template <class Resize, class Set>
bool decode_orientations(DecoderBuffer& buffer, std::int64_t count, int corners, Resize resize, Set set) {
    if (count < 0 || count > corners) return false;  // at most one for each corner is ever used
    resize(static_cast<int>(count));
    RAnsBitDecoder bits;
    if (!bits.StartDecoding(&buffer)) return false;
    bool orientation = true;
    for (int i = 0; i < static_cast<int>(count); ++i) {
        if (!bits.DecodeNextBit()) orientation = !orientation;
        set(i, orientation);
    }
    bits.EndDecoding();
    return true;
}

template <>
bool MeshPredictionSchemeTexCoordsPortableDecoder<int, WrapTransform, BaseMesh>::DecodePredictionData(
    DecoderBuffer* buffer) {
    std::int32_t count = 0;
    return buffer->Decode(&count) &&
           decode_orientations(
               *buffer, count, mesh_data().corner_table()->num_corners(),
               [&](int n) { predictor_.ResizeOrientations(n); },
               [&](int i, bool value) { predictor_.set_orientation(i, value); }) &&
           MeshPredictionSchemeDecoder<int, WrapTransform, BaseMesh>::DecodePredictionData(buffer);
}

template <>
bool MeshPredictionSchemeTexCoordsPortableDecoder<int, WrapTransform, SeamedMesh>::DecodePredictionData(
    DecoderBuffer* buffer) {
    std::int32_t count = 0;
    return buffer->Decode(&count) &&
           decode_orientations(
               *buffer, count, mesh_data().corner_table()->num_corners(),
               [&](int n) { predictor_.ResizeOrientations(n); },
               [&](int i, bool value) { predictor_.set_orientation(i, value); }) &&
           MeshPredictionSchemeDecoder<int, WrapTransform, SeamedMesh>::DecodePredictionData(buffer);
}

template <>
bool MeshPredictionSchemeTexCoordsDecoder<int, WrapTransform, BaseMesh>::DecodePredictionData(
    DecoderBuffer* buffer) {
    std::uint32_t count = 0;
    return DecodeVarint(&count, buffer) && count > 0 &&
           decode_orientations(
               *buffer, count, mesh_data().corner_table()->num_corners(),
               [&](int n) { orientations_.resize(static_cast<std::size_t>(n)); },
               [&](int i, bool value) { orientations_[static_cast<std::size_t>(i)] = value; }) &&
           MeshPredictionSchemeDecoder<int, WrapTransform, BaseMesh>::DecodePredictionData(buffer);
}

template <>
bool MeshPredictionSchemeTexCoordsDecoder<int, WrapTransform, SeamedMesh>::DecodePredictionData(
    DecoderBuffer* buffer) {
    std::uint32_t count = 0;
    return DecodeVarint(&count, buffer) && count > 0 &&
           decode_orientations(
               *buffer, count, mesh_data().corner_table()->num_corners(),
               [&](int n) { orientations_.resize(static_cast<std::size_t>(n)); },
               [&](int i, bool value) { orientations_[static_cast<std::size_t>(i)] = value; }) &&
           MeshPredictionSchemeDecoder<int, WrapTransform, SeamedMesh>::DecodePredictionData(buffer);
}

}  // namespace draco

namespace gridreel::anim::gltf {
namespace {

constexpr std::uint16_t newest_bitstream = 2 << 8 | 2;

/// Far more than the attributes of glTF that are read here.
constexpr int most_attributes = 64;

constexpr auto too_large = "decoding it takes more memory than a file of this size may ask for";

/// What the head of the connectivity claims.
struct Claims {
    std::uint32_t vertices = 0, triangles = 0;
    std::uint8_t attribute_tables = 0;  ///< corner tables besides that of the positions
};

/// What Draco 1.5.5 allocates for connectivity: for each triangle the corner table, the mesh and what is
/// being traversed; for each point the sequence of its decoding; and so again for each further corner table.
std::size_t connectivity_bytes(std::size_t triangles, std::size_t points, std::size_t tables) {
    return triangles * (64 + 16 * tables) + points * (32 + 16 * tables);
}

/// One of Draco's decoders, but for this: what the stream claims is checked before it is believed.
template <class Decoder>
class GuardedDecoder final : public Decoder {
public:
    explicit GuardedDecoder(const DracoRequest& request) : request_(request) {}

    [[nodiscard]] const std::string& refusal() const { return refusal_; }

private:
    static constexpr bool is_sequential = std::is_same_v<Decoder, draco::MeshSequentialDecoder>;

    bool DecodeConnectivity() override {
        refusal_ = check_connectivity();
        return refusal_.empty() && Decoder::DecodeConnectivity();
    }

    bool DecodeAllAttributes() override {
        refusal_ = check_attributes();
        return refusal_.empty() && Decoder::DecodeAllAttributes();
    }

    /// Reads ahead, without moving the decoder's own position.
    [[nodiscard]] bool read(Claims& claims) {
        draco::DecoderBuffer ahead = *this->buffer();
        if constexpr (is_sequential)
            return draco::DecodeVarint(&claims.triangles, &ahead) &&
                   draco::DecodeVarint(&claims.vertices, &ahead);
        else
            return draco::DecodeVarint(&claims.vertices, &ahead) &&
                   draco::DecodeVarint(&claims.triangles, &ahead) && ahead.Decode(&claims.attribute_tables);
    }

    [[nodiscard]] std::string check_connectivity() {
        Claims claims;
        if (!read(claims)) return "the Draco data is cut short";
        if (request_.triangles && claims.triangles != *request_.triangles)
            return fmt::format("the Draco data has {} triangles; the indices state {}", claims.triangles,
                               *request_.triangles);
        // Edgebreaker states vertices before seams part them into points.
        if (is_sequential ? claims.vertices != request_.points : claims.vertices > request_.points)
            return fmt::format("the Draco data has {} points; the attributes state {}", claims.vertices,
                               request_.points);
        if (claims.attribute_tables > most_attributes)
            return fmt::format("the Draco data has {} corner tables", claims.attribute_tables);
        if (connectivity_bytes(claims.triangles, request_.points, claims.attribute_tables) >
            request_.most_bytes)
            return too_large;
        return {};
    }

    [[nodiscard]] std::string check_attributes() {
        const draco::PointCloud& cloud = *this->point_cloud();
        if (cloud.num_points() != request_.points)
            return fmt::format("the Draco data has {} points; the attributes state {}", cloud.num_points(),
                               request_.points);
        if (cloud.num_attributes() > most_attributes)
            return fmt::format("the Draco data has {} attributes", cloud.num_attributes());

        // Decoded as integers, then as themselves, then handed over as at most four 32-bit components.
        std::size_t bytes_per_point = 0;
        for (int i = 0; i < cloud.num_attributes(); ++i) {
            const draco::PointAttribute& attribute = *cloud.attribute(i);
            const std::size_t components = attribute.num_components();
            const auto size = static_cast<std::size_t>(draco::DataTypeLength(attribute.data_type()));
            bytes_per_point += components * (2 * sizeof(std::int32_t) + size) + 4 * sizeof(float) + 8;
        }
        const std::size_t triangles = this->mesh()->num_faces();
        if (connectivity_bytes(triangles, request_.points, 0) + request_.points * bytes_per_point >
            request_.most_bytes)
            return too_large;
        return {};
    }

    const DracoRequest& request_;
    std::string refusal_;
};

template <class Decoder>
std::string decode_with(draco::DecoderBuffer& buffer, const DracoRequest& request, draco::Mesh& mesh) {
    GuardedDecoder<Decoder> decoder(request);
    const draco::DecoderOptions options;
    const draco::Status status = decoder.Decode(options, &buffer, &mesh);
    if (!decoder.refusal().empty()) return decoder.refusal();
    return status.ok() ? "" : fmt::format("the Draco data is damaged ({})", status.error_msg_string());
}

std::string decode_mesh(std::span<const std::byte> encoded, const DracoRequest& request, draco::Mesh& mesh) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(encoded.data()), encoded.size());
    draco::DecoderBuffer ahead = buffer;
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) return "this is not Draco data";
    if ((header.version_major << 8 | header.version_minor) != newest_bitstream)
        return fmt::format("the Draco data is of version {}.{}; 2.2 is read", header.version_major,
                           header.version_minor);
    if (header.encoder_type != draco::TRIANGULAR_MESH) return "the Draco data is not a triangle mesh";
    switch (header.encoder_method) {
        case draco::MESH_SEQUENTIAL_ENCODING:
            return decode_with<draco::MeshSequentialDecoder>(buffer, request, mesh);
        case draco::MESH_EDGEBREAKER_ENCODING:
            return decode_with<draco::MeshEdgebreakerDecoder>(buffer, request, mesh);
        default:
            return fmt::format("the Draco data is encoded by the unknown method {}", header.encoder_method);
    }
}

/// False when a value does not fit `T`.
template <class T>
bool copy_values(const draco::PointAttribute& attribute, std::size_t points, std::vector<std::byte>& out) {
    const auto components = static_cast<std::int8_t>(attribute.num_components());
    std::array<T, 4> values{};
    const std::size_t size = sizeof(T) * attribute.num_components();
    out.resize(points * size);
    for (std::size_t i = 0; i < points; ++i) {
        const auto value = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
        if (value.value() >= attribute.size()) return false;
        if (!attribute.ConvertValue<T>(value, components, values.data())) return false;
        std::memcpy(out.data() + i * size, values.data(), size);
    }
    return true;
}

bool copy_as(ComponentType type, const draco::PointAttribute& attribute, std::size_t points,
             std::vector<std::byte>& out) {
    switch (type) {
        case ComponentType::int8:
            return copy_values<std::int8_t>(attribute, points, out);
        case ComponentType::uint8:
            return copy_values<std::uint8_t>(attribute, points, out);
        case ComponentType::int16:
            return copy_values<std::int16_t>(attribute, points, out);
        case ComponentType::uint16:
            return copy_values<std::uint16_t>(attribute, points, out);
        case ComponentType::uint32:
            return copy_values<std::uint32_t>(attribute, points, out);
        case ComponentType::float32:
            return copy_values<float>(attribute, points, out);
    }
    return false;
}

/// The reason why the attribute is not as requested; empty when it is.
std::string copy_attribute(const draco::Mesh& mesh, const DracoAttribute& request,
                           std::vector<std::byte>& out) {
    const draco::PointAttribute* const attribute = mesh.GetAttributeByUniqueId(request.unique_id);
    if (!attribute)
        return fmt::format("{} is attribute {}, which the Draco data does not have", request.name,
                           request.unique_id);
    const auto type = attribute->data_type();
    const bool is_float = type == draco::DT_FLOAT32;
    const bool is_integer = type >= draco::DT_INT8 && type <= draco::DT_UINT32;
    if (attribute->num_components() != request.components ||
        !(request.component == ComponentType::float32 ? is_float : is_integer))
        return fmt::format("{} has {} components of {}; the Draco data has {} of its type {}", request.name,
                           request.components, name_of(request.component), attribute->num_components(),
                           static_cast<int>(type));
    if (!copy_as(request.component, *attribute, mesh.num_points(), out))
        return fmt::format("{} has values in the Draco data that do not fit {}", request.name,
                           name_of(request.component));
    return {};
}

}  // namespace

DracoMesh decode_draco(std::span<const std::byte> encoded, const DracoRequest& request) {
    draco::Mesh mesh;
    try {
        if (auto reason = decode_mesh(encoded, request, mesh); !reason.empty())
            return {.refusal = std::move(reason)};
    } catch (const std::exception&) {
        // The library asks for impossible amounts of memory where damaged counts slip through its checks.
        return {.refusal = "the Draco data is damaged"};
    }

    DracoMesh result;
    result.indices.reserve(std::size_t{3} * mesh.num_faces());
    for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
        for (const draco::PointIndex& point : mesh.face(face)) {
            if (point.value() >= mesh.num_points()) return {.refusal = "the Draco data is damaged"};
            result.indices.push_back(point.value());
        }
    for (const DracoAttribute& attribute : request.attributes)
        if (auto reason = copy_attribute(mesh, attribute, result.attributes.emplace_back()); !reason.empty())
            return {.refusal = std::move(reason)};
    return result;
}

}  // namespace gridreel::anim::gltf
