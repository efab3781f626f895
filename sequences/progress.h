#pragma once
// How far a run is, in words.

#include "sequences/frame_record.h"

#include <cstddef>
#include <string>

namespace gridreel::sequences {

struct Progress {
    std::size_t done = 0;  ///< frames, failed ones too
    std::size_t total = 0;
    double elapsed_s = 0.0;  ///< since the first frame began

    [[nodiscard]] double frames_per_second() const;
    [[nodiscard]] double left_s() const;  ///< at the pace so far
};

/// One line for a terminal, at most `columns` wide: a bar as long as fits, frames done, pace, time left,
/// rebuild and trace time of the last frame. No control characters.
[[nodiscard]] std::string progress_bar(const Progress& progress, const FrameRecord& last,
                                       std::size_t columns);

/// One line for a file of lines: which frame went where, or why it failed. No control characters, no newline.
[[nodiscard]] std::string progress_line(const Progress& progress, const FrameRecord& last);

/// 0:07, 12:34, 1:02:03.
[[nodiscard]] std::string clock_text(double seconds);

}  // namespace gridreel::sequences
