#pragma once
// Writing frames while the next ones render.

#include "engine/film.h"
#include "sequences/frame_record.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gridreel::sequences {

/// Films of a job: one renders, one is written, one waits.
inline constexpr std::size_t films_in_flight = 3;

/// A frame on its way from the renderer to its file.
struct RenderedFrame {
    FrameRecord record;
    engine::Film film;  ///< contents mean nothing when `record.failed()`
};

/// One thread that writes frames in the order they were handed over, behind a queue of fixed length.
/// At most `in_flight` films exist: whoever renders too fast waits in `film()`.
class FrameWriter {
public:
    /// Called on the writer's thread, one frame at a time, in order. What it throws ends the writing:
    /// frames still waiting are dropped and the caller gets the exception.
    using Write = std::function<void(RenderedFrame&)>;

    /// @param in_flight  >= 2: one renders while another is written
    FrameWriter(std::size_t in_flight, Write write);
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    /// Drops the frames still waiting; the one being written is finished.
    ~FrameWriter();

    /// A film to render into: a new one until `in_flight` exist, then the next that is written.
    /// @throws what `write` threw
    [[nodiscard]] engine::Film film();

    /// Hands a frame over. Its film comes from `film()`, also when the frame failed.
    void submit(RenderedFrame frame);

    /// Waits until everything is written.
    /// @throws what `write` threw
    void finish();

private:
    void work();

    const std::size_t in_flight_;
    const Write write_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<RenderedFrame> waiting_;
    std::vector<engine::Film> free_films_;
    std::size_t films_made_ = 0;
    bool writing_ = false;
    bool stop_ = false;
    std::exception_ptr failure_;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace gridreel::sequences
