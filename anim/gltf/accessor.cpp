#include "anim/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <limits>

namespace gridreel::anim::gltf {
namespace {

constexpr std::array<ElementType, 7> element_types{{
    {.name = "SCALAR", .rows = 1, .columns = 1},
    {.name = "VEC2", .rows = 2, .columns = 1},
    {.name = "VEC3", .rows = 3, .columns = 1},
    {.name = "VEC4", .rows = 4, .columns = 1},
    {.name = "MAT2", .rows = 2, .columns = 2},
    {.name = "MAT3", .rows = 3, .columns = 3},
    {.name = "MAT4", .rows = 4, .columns = 4},
}};

/// Bytes from one column to the next: matrix columns begin at multiples of four.
std::size_t column_bytes(const Accessor& accessor) {
    const std::size_t packed = accessor.element.rows * byte_count(accessor.component);
    return accessor.element.columns == 1 ? packed : (packed + 3) / 4 * 4;
}

/// Bytes of one element. The padding after its last column is not counted: it need not be there.
std::size_t element_bytes(const Accessor& accessor) {
    return column_bytes(accessor) * (accessor.element.columns - 1) +
           accessor.element.rows * byte_count(accessor.component);
}

/// Bytes from one element to the next where no stride is given.
std::size_t packed_stride(const Accessor& accessor) {
    return column_bytes(accessor) * accessor.element.columns;
}

/// Little-endian, from any address.
template <class T>
T load(const std::byte* address) {
    T value;
    std::memcpy(&value, address, sizeof value);
    return value;
}

std::uint32_t load_unsigned(const std::byte* address, ComponentType type) {
    switch (type) {
        case ComponentType::uint8:
            return load<std::uint8_t>(address);
        case ComponentType::uint16:
            return load<std::uint16_t>(address);
        case ComponentType::uint32:
            return load<std::uint32_t>(address);
        default:
            return 0;
    }
}

template <class T>
float load_scaled(const std::byte* address, bool normalized) {
    const auto value = static_cast<float>(load<T>(address));
    return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

float load_float(const std::byte* address, ComponentType type, bool normalized) {
    switch (type) {
        case ComponentType::int8:
            return load_scaled<std::int8_t>(address, normalized);
        case ComponentType::uint8:
            return load_scaled<std::uint8_t>(address, normalized);
        case ComponentType::int16:
            return load_scaled<std::int16_t>(address, normalized);
        case ComponentType::uint16:
            return load_scaled<std::uint16_t>(address, normalized);
        case ComponentType::uint32:
            return load_scaled<std::uint32_t>(address, false);
        case ComponentType::float32:
            return load<float>(address);
    }
    return 0.0f;
}

/// The first of `count` elements of `size` bytes, `stride` apart, at `offset` of a buffer view.
const std::byte* locate(const Place& place, std::span<const std::byte> view, std::size_t offset,
                        std::size_t count, std::size_t size, std::size_t stride) {
    const std::size_t needed = offset + (count - 1) * stride + size;
    if (needed > view.size()) {
        place.refuse(
            fmt::format("{} elements of {} bytes, {} apart from byte {}, need {} bytes; the buffer view "
                        "has {}",
                        count, size, stride, offset, needed, view.size()));
    }
    return view.data() + offset;
}

SparseElements resolve_sparse(const Place& place, const Accessor& accessor,
                              std::span<const std::span<const std::byte>> views) {
    const Place indices = place.at("indices"), values = place.at("values");
    SparseElements sparse{.count = place.at("count").integer(),
                          .index_type = static_cast<ComponentType>(indices.at("componentType").integer())};
    if (sparse.count > accessor.count)
        place.refuse(fmt::format("{} sparse elements replace some of only {}", sparse.count, accessor.count));

    const std::size_t index_size = byte_count(sparse.index_type), value_size = element_bytes(accessor);
    sparse.indices = locate(indices, views[indices.at("bufferView").index()],
                            indices.integer_or("byteOffset", 0), sparse.count, index_size, index_size);
    sparse.values = locate(values, views[values.at("bufferView").index()], values.integer_or("byteOffset", 0),
                           sparse.count, value_size, packed_stride(accessor));

    // Indices are in range and strictly increase.
    std::size_t next_allowed = 0;
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const std::size_t target = load_unsigned(sparse.indices + i * index_size, sparse.index_type);
        if (target >= accessor.count)
            indices.refuse(fmt::format("sparse index {} is {}, but the accessor has {} elements", i, target,
                                       accessor.count));
        if (target < next_allowed)
            indices.refuse(fmt::format("sparse index {} is {}: they must strictly increase", i, target));
        next_allowed = target + 1;
    }
    return sparse;
}

Accessor resolve(const Place& place, const Place& root, std::span<const std::span<const std::byte>> views) {
    const auto& type_name = place.at("type").text();
    Accessor accessor{.component = static_cast<ComponentType>(place.at("componentType").integer()),
                      .element = *std::find_if(element_types.begin(), element_types.end(),
                                               [&](const auto& type) { return type.name == type_name; }),
                      .normalized = place.boolean_or("normalized", false),
                      .count = place.at("count").integer()};
    if (accessor.normalized && (accessor.is_float() || accessor.component == ComponentType::uint32))
        place.at("normalized").refuse("floats and 32-bit integers cannot be normalized");

    if (const auto view = place.find_index("bufferView")) {
        const std::size_t size = element_bytes(accessor);
        accessor.stride = root.at("bufferViews", *view).integer_or("byteStride", packed_stride(accessor));
        if (accessor.stride < size && accessor.count > 1)
            place.refuse(fmt::format("elements of {} bytes overlap: the buffer view's stride is {}", size,
                                     accessor.stride));
        accessor.data = locate(place, views[*view], place.integer_or("byteOffset", 0), accessor.count, size,
                               accessor.stride);
    }
    if (const auto sparse = place.find("sparse")) accessor.sparse = resolve_sparse(*sparse, accessor, views);
    return accessor;
}

/// Calls `visit(first component's slot, component's address)` for every component there are bytes for.
template <class Visit>
void for_each_component(const Accessor& accessor, const Visit& visit) {
    const std::size_t size = byte_count(accessor.component), column = column_bytes(accessor);
    const auto visit_element = [&](std::size_t element, const std::byte* address) {
        std::size_t slot = element * accessor.element.components();
        for (std::uint32_t c = 0; c < accessor.element.columns; ++c)
            for (std::uint32_t r = 0; r < accessor.element.rows; ++r)
                visit(slot++, address + c * column + r * size);
    };

    if (accessor.data)
        for (std::size_t i = 0; i < accessor.count; ++i)
            visit_element(i, accessor.data + i * accessor.stride);

    const SparseElements& sparse = accessor.sparse;
    for (std::size_t i = 0; i < sparse.count; ++i) {
        const auto* const index = sparse.indices + i * byte_count(sparse.index_type);
        visit_element(load_unsigned(index, sparse.index_type), sparse.values + i * packed_stride(accessor));
    }
}

}  // namespace

std::size_t byte_count(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
        case ComponentType::uint8:
            return 1;
        case ComponentType::int16:
        case ComponentType::uint16:
            return 2;
        case ComponentType::uint32:
        case ComponentType::float32:
            return 4;
    }
    return 0;
}

std::string_view name_of(ComponentType type) {
    switch (type) {
        case ComponentType::int8:
            return "BYTE";
        case ComponentType::uint8:
            return "UNSIGNED_BYTE";
        case ComponentType::int16:
            return "SHORT";
        case ComponentType::uint16:
            return "UNSIGNED_SHORT";
        case ComponentType::uint32:
            return "UNSIGNED_INT";
        case ComponentType::float32:
            return "FLOAT";
    }
    return "?";
}

std::vector<Accessor> resolve_accessors(const Place& root,
                                        std::span<const std::span<const std::byte>> views) {
    std::vector<Accessor> accessors;
    if (const auto places = root.find("accessors"))
        for (std::size_t i = 0; i < places->size(); ++i)
            accessors.push_back(resolve((*places)[i], root, views));
    return accessors;
}

std::vector<float> read_floats(const Accessor& accessor) {
    std::vector<float> values(accessor.count * accessor.element.components(), 0.0f);
    for_each_component(accessor, [&](std::size_t slot, const std::byte* address) {
        values[slot] = load_float(address, accessor.component, accessor.normalized);
    });
    return values;
}

std::vector<std::uint32_t> read_integers(const Accessor& accessor) {
    std::vector<std::uint32_t> values(accessor.count * accessor.element.components(), 0);
    for_each_component(accessor, [&](std::size_t slot, const std::byte* address) {
        values[slot] = load_unsigned(address, accessor.component);
    });
    return values;
}

}  // namespace gridreel::anim::gltf
