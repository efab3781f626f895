#pragma once
// How a running job reports: libraries never print.

#include "sequences/frame_record.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gridreel::sequences {

struct JobStart {
    std::string clip;  ///< what plays, a phrase
    std::size_t frames = 0;
    std::int32_t width = 0;
    std::int32_t height = 0;
};

/// Gets told what happens, in order and never by two threads at once.
class JobObserver {
public:
    JobObserver() = default;
    JobObserver(const JobObserver&) = delete;
    JobObserver& operator=(const JobObserver&) = delete;
    virtual ~JobObserver() = default;

    /// Before the first frame.
    virtual void started(const JobStart& start) = 0;

    /// Something the file does not, or not wholly, get.
    virtual void warning(std::string_view text) = 0;

    /// Something that was decided rather than asked for.
    virtual void note(std::string_view text) = 0;

    /// A frame's file is in place, or it failed. Comes from the writer's thread, in frame order.
    virtual void frame_done(const FrameRecord& record) = 0;
};

}  // namespace gridreel::sequences
