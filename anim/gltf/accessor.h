#pragma once
// Typed views of the file's bytes (glTF 2.0, section 3.6).

#include "anim/gltf/place.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gridreel::anim::gltf {

/// Values as in the file.
enum class ComponentType : std::uint16_t {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126,
};

[[nodiscard]] std::size_t byte_count(ComponentType type);
[[nodiscard]] std::string_view name_of(ComponentType type);

/// An element as a matrix of `columns` columns; scalars and vectors have one.
struct ElementType {
    std::string_view name;  ///< "VEC3"
    std::uint32_t rows = 1, columns = 1;

    [[nodiscard]] std::uint32_t components() const { return rows * columns; }
};

/// Elements that replace those of the accessor's own buffer view; the indices are checked.
struct SparseElements {
    std::size_t count = 0;
    ComponentType index_type = ComponentType::uint8;
    const std::byte* indices = nullptr;  ///< tightly packed
    const std::byte* values = nullptr;   ///< tightly packed elements
};

/// An accessor whose every byte is known to be there. Refers to the document's buffers.
struct Accessor {
    ComponentType component = ComponentType::float32;
    ElementType element{};
    bool normalized = false;
    std::size_t count = 0;            ///< elements, >= 1
    const std::byte* data = nullptr;  ///< the first element; null: all zeros
    std::size_t stride = 0;           ///< bytes from one element to the next
    SparseElements sparse{};

    [[nodiscard]] bool is(std::string_view element_name) const { return element.name == element_name; }
    [[nodiscard]] bool is_float() const { return component == ComponentType::float32; }
};

/// Checks and resolves every accessor of the file.
///
/// Alignment is not demanded. Columns of matrices begin at multiples of four bytes (section 3.6.2.4).
///
/// @param views  the bytes of each buffer view
/// @throws Error for elements beyond their view, overlapping strides, sparse
/// indices
///         that are out of range or not strictly increasing
[[nodiscard]] std::vector<Accessor> resolve_accessors(const Place& root,
                                                      std::span<const std::span<const std::byte>> views);

/// All components, element by element, columns of matrices one after another; sparse elements in place.
/// Normalised integers become [0, 1] or [-1, 1] as in section 3.6.2.2; other integers their value.
/// Not-a-numbers and infinities come as they are.
[[nodiscard]] std::vector<float> read_floats(const Accessor& accessor);

/// The same for unsigned integers that are not normalised; others read as 0.
[[nodiscard]] std::vector<std::uint32_t> read_integers(const Accessor& accessor);

}  // namespace gridreel::anim::gltf
