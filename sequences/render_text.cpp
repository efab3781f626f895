#include "sequences/render_text.h"

#include "anim/parse_number.h"
#include "engine/srgb.h"
#include "sequences/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

namespace gridreel::sequences {
namespace {

bool is_side(std::optional<std::int32_t> side) {
    return side && *side >= 1 && *side <= max_picture_side;
}

/// `rrggbb` or `rrggbbaa`.
std::optional<glm::vec4> parse_hex(std::string_view digits) {
    if (digits.size() != 6 && digits.size() != 8) return std::nullopt;
    glm::vec4 color{1.0f};
    for (std::size_t i = 0; i * 2 < digits.size(); ++i) {
        unsigned byte = 0;
        const char* const begin = digits.data() + i * 2;
        const auto [end, error] = std::from_chars(begin, begin + 2, byte, 16);
        if (error != std::errc{} || end != begin + 2) return std::nullopt;
        const float encoded = float(byte) / 255.0f;
        color[static_cast<int>(i)] = i < 3 ? engine::linear_from_srgb(encoded) : encoded;
    }
    return color;
}

/// `r,g,b` or `r,g,b,a`.
std::optional<glm::vec4> parse_numbers(std::string_view text) {
    std::vector<float> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t comma = std::min(text.find(',', begin), text.size());
        const auto value = parse_number<float>(text.substr(begin, comma - begin));
        if (!value || !std::isfinite(*value) || *value < 0.0f) return std::nullopt;
        numbers.push_back(*value);
        begin = comma + 1;
    }
    if (numbers.size() == 3) numbers.push_back(1.0f);
    if (numbers.size() != 4 || numbers[3] > 1.0f) return std::nullopt;
    return glm::vec4{numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace

PictureSize parse_size(std::string_view text) {
    const std::size_t x = text.find('x');
    if (x != std::string_view::npos) {
        const auto width = parse_number<std::int32_t>(text.substr(0, x));
        const auto height = parse_number<std::int32_t>(text.substr(x + 1));
        const bool from_aspect = x + 1 == text.size();
        if (is_side(width) && (from_aspect || is_side(height))) return {.width = *width, .height = height};
    }
    throw UsageError(fmt::format("'{}' is not a picture size", text), "--size",
                     fmt::format("write 1280x720, or 1280x for the camera's aspect, with sides from 1 to {}",
                                 max_picture_side));
}

glm::vec4 parse_background(std::string_view text) {
    if (text == "transparent") return glm::vec4{0.0f};
    const auto color = text.starts_with('#') ? parse_hex(text.substr(1)) : parse_numbers(text);
    if (color) return *color;
    throw UsageError(
        fmt::format("'{}' is not a colour", text), "--background",
        "write #rrggbb or #rrggbbaa (sRGB), three or four linear numbers 0.2,0.2,0.2, or transparent");
}

std::optional<float> parse_lambda(std::string_view text) {
    if (text == "auto") return std::nullopt;
    if (text == "paper") return 5.0f;
    const auto value = parse_number<float>(text);
    if (value && std::isfinite(*value) && *value > 0.0f) return value;
    throw UsageError(fmt::format("'{}' is not a number of cells per triangle", text), "--lambda",
                     "give a number above 0, paper, or auto");
}

}  // namespace gridreel::sequences
