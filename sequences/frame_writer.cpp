#include "sequences/frame_writer.h"

#include <cassert>
#include <utility>

namespace gridreel::sequences {

FrameWriter::FrameWriter(std::size_t in_flight, Write write)
    : in_flight_(in_flight), write_(std::move(write)), thread_([this] { work(); }) {
    assert(in_flight >= 2);
}

FrameWriter::~FrameWriter() {
    {
        const std::lock_guard lock(mutex_);
        waiting_.clear();
        stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

engine::Film FrameWriter::film() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || !free_films_.empty() || films_made_ < in_flight_; });
    if (failure_) std::rethrow_exception(failure_);
    if (free_films_.empty()) {
        ++films_made_;
        return {};
    }
    engine::Film film = std::move(free_films_.back());
    free_films_.pop_back();
    return film;
}

void FrameWriter::submit(RenderedFrame frame) {
    {
        const std::lock_guard lock(mutex_);
        if (failure_) return;  // `film` or `finish` will tell
        waiting_.push_back(std::move(frame));
    }
    changed_.notify_all();
}

void FrameWriter::finish() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || (waiting_.empty() && !writing_); });
    if (failure_) std::rethrow_exception(failure_);
}

void FrameWriter::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return stop_ || !waiting_.empty(); });
        if (stop_) return;
        RenderedFrame frame = std::move(waiting_.front());
        waiting_.pop_front();
        writing_ = true;

        lock.unlock();
        std::exception_ptr failure;
        try {
            write_(frame);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();

        writing_ = false;
        free_films_.push_back(std::move(frame.film));
        if (failure) {
            failure_ = failure;
            waiting_.clear();
        }
        changed_.notify_all();
        if (failure) return;
    }
}

}  // namespace gridreel::sequences
