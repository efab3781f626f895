#include "sequences/frame_writer.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

using namespace gridreel;
using namespace gridreel::sequences;

namespace {

RenderedFrame frame_of(Frame number, engine::Film film) {
    RenderedFrame frame;
    frame.record.frame = number;
    frame.film = std::move(film);
    return frame;
}

void pause(int ms) {
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

}  // namespace

TEST_CASE("frames are written in the order they come, each with its own pixels", "[frame_writer]") {
    std::vector<Frame> written;
    std::vector<float> marks;
    {
        FrameWriter writer(3, [&](RenderedFrame& frame) {
            if (frame.record.frame % 3 == 0) pause(2);
            written.push_back(frame.record.frame);
            marks.push_back(frame.film.pixels.at(0));
        });
        for (Frame number = 0; number < 20; ++number) {
            engine::Film film = writer.film();
            film.resize(2, 2);
            film.pixels[0] = float(number);
            writer.submit(frame_of(number, std::move(film)));
        }
        writer.finish();
        CHECK(written.size() == 20);
    }
    for (std::size_t i = 0; i < written.size(); ++i) {
        CHECK(written[i] == Frame(i));
        CHECK(marks[i] == float(i));
    }
}

TEST_CASE("a slow disk holds rendering back: films are recycled, never more than asked for",
          "[frame_writer]") {
    std::atomic<int> in_flight{0};
    std::atomic<int> most{0};
    std::vector<const float*> buffers;
    FrameWriter writer(3, [&](RenderedFrame&) {
        pause(3);
        --in_flight;
    });
    for (Frame number = 0; number < 12; ++number) {
        engine::Film film = writer.film();
        most = std::max(most.load(), ++in_flight);
        film.resize(4, 4);
        if (std::find(buffers.begin(), buffers.end(), film.pixels.data()) == buffers.end()) {
            buffers.push_back(film.pixels.data());
        }
        writer.submit(frame_of(number, std::move(film)));
    }
    writer.finish();
    CHECK(in_flight == 0);
    CHECK(most <= 4);  // a film counts as free again only after `write` has returned
    CHECK(buffers.size() == 3);
}

TEST_CASE("rendering goes on while a frame is written", "[frame_writer]") {
    std::atomic<bool> second_rendered{false};
    bool overlapped = false;
    FrameWriter writer(2, [&](RenderedFrame& frame) {
        for (int i = 0; frame.record.frame == 0 && i < 2000 && !second_rendered; ++i) pause(1);
        if (frame.record.frame == 0) overlapped = second_rendered;
    });
    writer.submit(frame_of(0, writer.film()));
    engine::Film second = writer.film();  // must not wait for frame 0
    second_rendered = true;
    writer.submit(frame_of(1, std::move(second)));
    writer.finish();
    CHECK(overlapped);
}

TEST_CASE("what writing throws reaches the renderer, and later frames are dropped", "[frame_writer]") {
    std::vector<Frame> begun;
    FrameWriter writer(2, [&](RenderedFrame& frame) {
        begun.push_back(frame.record.frame);
        if (frame.record.frame == 1) throw std::runtime_error("disk full");
    });
    const auto render_all = [&] {
        for (Frame number = 0; number < 50; ++number) writer.submit(frame_of(number, writer.film()));
        writer.finish();
    };
    CHECK_THROWS_WITH(render_all(), "disk full");
    CHECK_THROWS_WITH(writer.finish(), "disk full");
    CHECK(begun == std::vector<Frame>{0, 1});
}

TEST_CASE("a writer that is dropped finishes the frame at hand and no other", "[frame_writer]") {
    std::atomic<int> begun{0};
    std::atomic<int> done{0};
    {
        FrameWriter writer(4, [&](RenderedFrame&) {
            ++begun;
            pause(20);
            ++done;
        });
        for (Frame number = 0; number < 3; ++number) writer.submit(frame_of(number, writer.film()));
        while (begun == 0) pause(1);
    }
    CHECK(begun == done);
    CHECK(done < 3);
}
