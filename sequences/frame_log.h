#pragma once
// The log of a run: one JSON object per line, the run first, then its frames.

#include "sequences/frame_record.h"
#include "sequences/job.h"

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace gridreel::sequences {

/// What a run is, once the scene is loaded.
struct RunRecord {
    Job job;
    std::string scene_sha256;
    std::vector<std::string> animations;  ///< names of those that play
    std::vector<Frame> frames;
    std::int32_t width = 0;
    std::int32_t height = 0;
    std::string instruction_set;  ///< that the kernels run with
};

/// One line each, ended by a newline; the schemas are `gridreel.run/1` and `gridreel.frame/1`.
[[nodiscard]] std::string log_line(const RunRecord& run);
[[nodiscard]] std::string log_line(const FrameRecord& frame);

/// Appends lines to a file, each on disk before the next.
class FrameLog {
public:
    /// Opens `file`, made if need be. A line that an earlier run left unfinished is ended.
    /// @throws OutputError
    explicit FrameLog(std::filesystem::path file);

    /// @throws OutputError
    template <class Record>
    void append(const Record& record) {
        write(log_line(record));
    }

private:
    void write(const std::string& text);

    std::filesystem::path file_;
    std::ofstream stream_;
};

}  // namespace gridreel::sequences
