#include "sequences/run_job.h"

#include "sequences/build_info.h"
#include "sequences/errors.h"
#include "sequences/fingerprint.h"
#include "sequences/frame_log.h"
#include "sequences/frame_writer.h"
#include "sequences/image_writer.h"
#include "sequences/picture.h"
#include "sequences/whole_file.h"
#include "traversal/simd_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <string>
#include <utility>

namespace gridreel::sequences {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void check_job(const Job& job) {
    check(job.image);
    check_numbered(job.take, job.output);
}

RunRecord describe_run(const Job& job, const anim::Scene& scene, const anim::Clip& clip,
                       const engine::FrameRenderer& renderer, const std::vector<Frame>& frames) {
    std::vector<std::string> animations;
    for (const anim::Index animation : clip.animations)
        animations.push_back(scene.animations[animation].name);
    return {.job = job,
            .scene_sha256 = scene_sha256(job.take.scene_file, job.take.asset_root),
            .animations = std::move(animations),
            .frames = frames,
            .width = renderer.width(),
            .height = renderer.height(),
            .instruction_set = std::string(traversal::simd_target())};
}

/// Everything that happens to a frame after rendering, on the writer's thread.
class Finisher {
public:
    Finisher(const Job& job, FrameLog& log, JobObserver& observer, std::vector<FrameRecord>& finished)
        : job_(job), log_(log), observer_(observer), finished_(finished) {}

    void operator()(RenderedFrame& frame) {
        FrameRecord& record = frame.record;
        std::exception_ptr failure;
        if (!record.failed()) failure = write(frame);
        record.peak_bytes = peak_memory_bytes();
        log_.append(record);
        observer_.frame_done(record);
        finished_.push_back(std::move(record));
        if (failure && !job_.keep_going) std::rethrow_exception(failure);
    }

private:
    /// @return what went wrong, if anything
    std::exception_ptr write(RenderedFrame& frame) {
        const auto start = Clock::now();
        try {
            store(frame.film, job_.image, picture_);
            frame.record.pixels_sha256 = sha256_hex(picture_.pixels);
            write_image(picture_, job_.image, frame.record.file);
        } catch (const std::exception& error) {
            frame.record.error = error.what();
            return std::current_exception();
        }
        frame.record.write_ms = ms_since(start);
        return nullptr;
    }

    const Job& job_;
    FrameLog& log_;
    JobObserver& observer_;
    std::vector<FrameRecord>& finished_;
    Picture picture_;
};

/// Renders one frame; what goes wrong is told in the record, and thrown again by the caller.
std::exception_ptr render(engine::FrameRenderer& renderer, RenderedFrame& frame) {
    const auto start = Clock::now();
    try {
        frame.record.render = renderer.render(frame.record.time_s, frame.film);
    } catch (const std::exception& error) {
        frame.record.error = error.what();
        return std::current_exception();
    }
    frame.record.render_ms = ms_since(start);
    return nullptr;
}

}  // namespace

std::size_t JobResult::failed_frames() const {
    return static_cast<std::size_t>(
        std::count_if(frames.begin(), frames.end(), [](const FrameRecord& frame) { return frame.failed(); }));
}

JobResult run_job(const Job& job, JobObserver& observer, const std::atomic<bool>& stop) {
    check_job(job);
    limit_image_threads(job.threads);

    // Everything that can be refused is refused before the first frame.
    const anim::Scene scene = load_scene(job.take).scene;
    for (const anim::Warning& warning : scene.warnings) observer.warning(describe(warning));
    const anim::Clip clip = choose_clip(scene, job.take);
    const std::vector<Frame> frames = choose_frames(job.take, scene, clip, job.output);
    check_camera(scene, clip, job.render.camera);
    engine::FrameRenderer renderer(scene, clip, job.render);
    make_folder(job.output.folder());
    FrameLog log(job.log);
    log.append(describe_run(job, scene, clip, renderer, frames));
    for (const std::string& note : renderer.notes()) observer.note(note);
    observer.started({.clip = describe(scene, clip),
                      .frames = frames.size(),
                      .width = renderer.width(),
                      .height = renderer.height()});

    JobResult result;
    FrameWriter writer(films_in_flight, Finisher(job, log, observer, result.frames));
    for (const Frame number : frames) {
        result.interrupted = stop.load();
        if (result.interrupted) break;

        RenderedFrame frame;
        frame.record.frame = number;
        frame.record.time_s = job.take.rate.time_of(number);
        frame.record.file = job.output.path(number);
        frame.film = writer.film();
        const std::exception_ptr failure = render(renderer, frame);
        writer.submit(std::move(frame));
        if (failure && !job.keep_going) {
            writer.finish();
            std::rethrow_exception(failure);
        }
    }
    writer.finish();
    return result;
}

}  // namespace gridreel::sequences
