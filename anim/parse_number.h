#pragma once
// Numbers as people write them.

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace gridreel {

/// The number that the whole of `text` is, as `std::from_chars` reads it in any locale: no blanks, no leading
/// plus; floating point may be `inf` or `nan`.
/// @return nothing for anything else, and for what `Number` cannot hold
template <class Number>
[[nodiscard]] std::optional<Number> parse_number(std::string_view text) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return number;
}

}  // namespace gridreel
