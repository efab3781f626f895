#pragma once
// Lists of frames as people write them: `7`, `1-240`, `1-240x2`, `1,5,10-20`, `-5--1`, `last`.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gridreel::sequences {

using Frame = std::int64_t;  ///< may be negative

inline constexpr Frame max_frame_number = 1'000'000'000;  ///< and its negative
inline constexpr std::size_t max_frames = 1'000'000;      ///< in one list

/// Stands for `last` until the clip is known (`choose_frames`).
inline constexpr Frame clip_end = max_frame_number + 1;

/// Frames in the order written, the second and later mentions of a frame dropped.
///
/// @param text  comma-separated items: a frame, `first-last`, `first-lastxstep` with first <= last and
///              step >= 1, or the word `last`, read as `clip_end`
/// @throws UsageError naming the item, for anything else, numbers beyond `max_frame_number`,
///         or more than `max_frames` frames
[[nodiscard]] std::vector<Frame> parse_frame_list(std::string_view text);

/// first, first + 1, … last; empty when first > last.
[[nodiscard]] std::vector<Frame> frame_range(Frame first, Frame last);

/// The shortest list that reads back as `frames`, steps of one folded: `1,5,10-20`.
[[nodiscard]] std::string to_string(std::span<const Frame> frames);

}  // namespace gridreel::sequences
