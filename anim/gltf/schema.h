#pragma once
// The shape that the JSON of a glTF file must have: types, required properties, ranges, references.

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace gridreel::anim::gltf {

struct Shape;

enum class Kind {
    boolean,
    number,
    integer,    ///< 0 … 2^53 and inside [least, most]
    text,       ///< one of `words`, when there are any
    index,      ///< into the array `into`
    index_map,  ///< an object with an index into `into` under every name
    object,     ///< of shape `shape`
};

/// How many items a list may have.
struct Length {
    std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();
};

/// One property of an object.
struct Property {
    std::string_view name;
    Kind kind = Kind::number;
    bool required = false;
    bool list = false;  ///< an array of values of `kind`
    Length length{};
    double least = -std::numeric_limits<float>::max(), most = std::numeric_limits<float>::max();
    bool above_least = false;  ///< `least` itself is refused
    std::string_view into{};   ///< an array of the root; or "lights", "variants" of their extension there
    std::span<const std::string_view> words{};
    std::span<const int> codes{};  ///< allowed integers; empty: any
    const Shape* shape = nullptr;
};

struct Shape {
    std::span<const Property> properties;
};

/// The root object: every property that this reader looks at (glTF 2.0, chapter 5, and the extensions that it
/// knows). Others are left alone. Empty arrays are tolerated.
[[nodiscard]] const Shape& root_shape();

// Parts of it that have a file of their own: what surfaces look like.
extern const Shape material_shape, texture_shape, texture_sampler_shape, image_shape;

}  // namespace gridreel::anim::gltf
