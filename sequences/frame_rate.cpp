#include "sequences/frame_rate.h"

#include "anim/parse_number.h"
#include "sequences/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gridreel::sequences {
namespace {

std::optional<double> positive_number(std::string_view text) {
    const auto number = parse_number<double>(text);
    return number && std::isfinite(*number) && *number > 0.0 ? number : std::nullopt;
}

}  // namespace

FrameRate parse_frame_rate(std::string_view text) {
    const std::size_t slash = text.find('/');
    const bool ratio = slash != std::string_view::npos;
    const auto numerator = positive_number(text.substr(0, slash));
    const auto denominator = ratio ? positive_number(text.substr(slash + 1)) : std::optional{1.0};
    if (numerator && denominator) {
        const FrameRate rate{.numerator = *numerator, .denominator = *denominator};
        if (rate.per_second() >= 0.001 && rate.per_second() <= 100'000.0) return rate;
    }
    throw UsageError(fmt::format("'{}' is not a frame rate", text), "--fps",
                     "give frames per second from 0.001 to 100000, such as 24, 39.95 or 30000/1001");
}

std::string to_string(const FrameRate& rate) {
    if (rate.denominator == 1.0) return fmt::format("{}", rate.numerator);
    return fmt::format("{}/{}", rate.numerator, rate.denominator);
}

Frame last_frame(double duration_s, const FrameRate& rate) {
    const double frames = std::max(duration_s, 0.0) * rate.numerator / rate.denominator;
    const double rounding = std::max(1e-4, frames * double(std::numeric_limits<float>::epsilon()));
    return static_cast<Frame>(std::min(std::floor(frames + rounding), 0x1p53));
}

}  // namespace gridreel::sequences
