#pragma once
// Frames per second, and what time a frame is.

#include "sequences/frame_list.h"

#include <string>
#include <string_view>

namespace gridreel::sequences {

/// Frames per second as written: `24`, `39.95` or `30000/1001`.
struct FrameRate {
    double numerator = 24.0;   ///< > 0, finite
    double denominator = 1.0;  ///< > 0, finite

    [[nodiscard]] double per_second() const { return numerator / denominator; }

    /// Seconds, computed from the frame alone: no step is ever accumulated.
    [[nodiscard]] double time_of(Frame frame) const { return double(frame) * denominator / numerator; }

    friend bool operator==(const FrameRate&, const FrameRate&) = default;
};

/// @throws UsageError unless `text` is a positive number or a ratio of two, in [0.001, 100000] altogether
[[nodiscard]] FrameRate parse_frame_rate(std::string_view text);

/// The shortest text that `parse_frame_rate` reads back.
[[nodiscard]] std::string to_string(const FrameRate& rate);

/// The last frame of a clip: floor(duration * fps), 0 for a still.
///
/// Key times are floats in the file, so 2.0833333 s at 24 fps must count as 50 frames and not as
/// 49.9999992: a frame that lies beyond the end by less than the rounding of a float, or a
/// ten-thousandth of a frame, is still in.
/// @return at most 2^53, up to which JSON readers keep whole numbers exact
[[nodiscard]] Frame last_frame(double duration_s, const FrameRate& rate);

}  // namespace gridreel::sequences
