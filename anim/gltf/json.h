#pragma once
// A parsed JSON text.

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace gridreel::anim::gltf {

/// Up to here a double counts every integer.
inline constexpr double exact_integers = 9007199254740992.0;  // 2^53

/// One JSON value. Numbers are doubles: exact for integers up to 2^53, the range glTF allows.
struct Json {
    using Array = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;  ///< in file order, names unique

    std::variant<std::nullptr_t, bool, double, std::string, Array, Object> value = nullptr;

    /// The property of that name; null when absent or when this is not an object.
    [[nodiscard]] const Json* find(std::string_view name) const;
    [[nodiscard]] Json* find(std::string_view name);
};

/// Parses UTF-8 text.
///
/// @param where  names the text in errors
/// @throws Error for text that is not JSON or not UTF-8, numbers beyond double, names that appear twice
///         in one object, and nesting deeper than 128 levels
[[nodiscard]] Json parse_json(std::string_view text, std::string_view where);

/// The value as text; integers without a fraction.
[[nodiscard]] std::string write_json(const Json& json);

}  // namespace gridreel::anim::gltf
