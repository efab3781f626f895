#pragma once
// Render settings as people write them: picture size, background, λ.

#include <glm/vec4.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace gridreel::sequences {

struct PictureSize {
    std::int32_t width = 1280;                 ///< pixels
    std::optional<std::int32_t> height = 720;  ///< pixels; absent: from the camera's aspect
};

inline constexpr std::int32_t max_picture_side = 32'768;  ///< pixels

/// `1280x720`, or `1280x` for the camera's aspect.
/// @throws UsageError unless both sides are in [1, max_picture_side]
[[nodiscard]] PictureSize parse_size(std::string_view text);

/// A background: linear RGB, not premultiplied, and alpha.
///
/// `#rrggbb` and `#rrggbbaa` are sRGB as in any picture program; three or four numbers separated by
/// commas are linear light and may exceed 1; `transparent` is nothing at all.
/// @throws UsageError for anything else, negative numbers, or an alpha above 1
[[nodiscard]] glm::vec4 parse_background(std::string_view text);

/// Cells per triangle of the grid: a number > 0, `paper` for 5 (Wald et al. 2006), nothing for `auto`.
/// @throws UsageError
[[nodiscard]] std::optional<float> parse_lambda(std::string_view text);

}  // namespace gridreel::sequences
