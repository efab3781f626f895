#pragma once
// A whole job: load once, render every frame, write each while the next one renders.

#include "sequences/frame_record.h"
#include "sequences/job.h"
#include "sequences/job_observer.h"

#include <atomic>
#include <vector>

namespace gridreel::sequences {

struct JobResult {
    std::vector<FrameRecord> frames;  ///< in the order asked for, as far as it came
    bool interrupted = false;         ///< `stop` was set before the last frame

    [[nodiscard]] std::size_t failed_frames() const;
};

/// Renders and writes the job's frames, and logs each when its file is in place.
///
/// Work runs in the calling thread's TBB arena, plus one thread that writes. When `stop` becomes true
/// no further frame is begun; those rendered by then are written.
///
/// @throws UsageError   when the options contradict each other or the scene
/// @throws OutputError  when folder, log or (unless `keep_going`) a frame cannot be written
/// @throws Error        when the scene cannot be loaded or (unless `keep_going`) a frame not rendered;
///                      frames before it are in place and in the log
JobResult run_job(const Job& job, JobObserver& observer, const std::atomic<bool>& stop);

}  // namespace gridreel::sequences
