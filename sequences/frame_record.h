#pragma once
// What became of one frame: the log's line, the table's row.

#include "engine/frame_renderer.h"
#include "sequences/frame_list.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace gridreel::sequences {

/// One frame that was rendered and written, or failed.
struct FrameRecord {
    Frame frame = 0;
    double time_s = 0.0;
    engine::FrameReport render;
    double render_ms = 0.0;  ///< wall clock of the whole render call
    double write_ms = 0.0;   ///< rounding, hashing, encoding and disk, on the writer's thread
    std::size_t peak_bytes = 0;
    std::filesystem::path file;
    std::string pixels_sha256;  ///< over `Picture::pixels`
    std::string error;          ///< empty: the file is in place; else why it is not

    [[nodiscard]] bool failed() const { return !error.empty(); }
    [[nodiscard]] double total_ms() const { return render_ms + write_ms; }
};

}  // namespace gridreel::sequences
