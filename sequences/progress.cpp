#include "sequences/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridreel::sequences {

double Progress::frames_per_second() const {
    return elapsed_s > 0.0 ? double(done) / elapsed_s : 0.0;
}

double Progress::left_s() const {
    return done > 0 ? elapsed_s / double(done) * double(total - done) : 0.0;
}

std::string clock_text(double seconds) {
    const auto whole = std::llround(std::clamp(seconds, 0.0, 1e9));
    const auto hours = whole / 3600;
    const auto minutes = whole / 60 % 60;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                     : fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string progress_bar(const Progress& progress, const FrameRecord& last, std::size_t columns) {
    std::string text =
        fmt::format("{}/{}  frame {}  {:.2f} frames/s  {} left  rebuild {:.1f} ms  trace {:.1f} ms",
                    progress.done, progress.total, last.frame, progress.frames_per_second(),
                    clock_text(progress.left_s()), last.render.rebuild.total_ms, last.render.trace_ms);
    constexpr std::size_t longest_bar = 30;
    constexpr std::size_t frame_of_bar = 4;  // brackets and two spaces
    if (text.size() + frame_of_bar < columns) {
        const std::size_t length = std::min(columns - text.size() - frame_of_bar, longest_bar);
        const std::size_t full = progress.total > 0 ? length * progress.done / progress.total : 0;
        text = fmt::format("[{}{}]  {}", std::string(full, '='), std::string(length - full, ' '), text);
    }
    text.resize(std::min(text.size(), columns));
    return text;
}

std::string progress_line(const Progress& progress, const FrameRecord& last) {
    if (last.failed()) {
        return fmt::format("{}/{} frame {} failed: {}", progress.done, progress.total, last.frame,
                           last.error);
    }
    return fmt::format("{}/{} frame {} -> {} (rebuild {:.1f} ms, trace {:.1f} ms, total {:.1f} ms)",
                       progress.done, progress.total, last.frame, last.file.string(),
                       last.render.rebuild.total_ms, last.render.trace_ms, last.total_ms());
}

}  // namespace gridreel::sequences
