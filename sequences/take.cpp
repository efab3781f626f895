#include "sequences/take.h"

#include "anim/load.h"
#include "anim/repeats.h"
#include "anim/variants.h"
#include "engine/choose_camera.h"
#include "sequences/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace gridreel::sequences {
namespace {

void check_numbered(std::size_t frame_count, const FramePattern& output) {
    if (frame_count <= 1 || output.has_number()) return;
    throw UsageError(fmt::format("'{}' has no place for the number of {} frames", output.text(), frame_count),
                     "--output", "add #### or %04d to the file name, or choose one frame with --frames");
}

UsageError too_long(double duration_s, const FrameRate& rate) {
    return {fmt::format("the clip lasts {} s, more than {} frames at {} fps", duration_s, max_frames,
                        to_string(rate)),
            "--frames", "name the frames to render"};
}

std::vector<Frame> whole_clip(const Take& take, const anim::Scene& scene, const anim::Clip& clip) {
    const Frame last = last_frame(clip.duration_s, take.rate);
    if (last >= static_cast<Frame>(max_frames)) throw too_long(clip.duration_s, take.rate);
    const bool comes_back = take.loop && last > 0 && anim::repeats(scene, clip, 0.0, take.rate.time_of(last));
    return frame_range(0, comes_back ? last - 1 : last);
}

/// The list with the clip's last frame in the place of `clip_end`, unless the list has that frame already.
std::vector<Frame> with_last(std::vector<Frame> frames, double duration_s, const FrameRate& rate) {
    const auto end = std::find(frames.begin(), frames.end(), clip_end);
    if (end == frames.end()) return frames;
    const Frame last = last_frame(duration_s, rate);
    if (last > max_frame_number) throw too_long(duration_s, rate);
    if (std::find(frames.begin(), frames.end(), last) == frames.end()) {
        *end = last;
    } else {
        frames.erase(end);
    }
    return frames;
}

}  // namespace

LoadedScene load_scene(const Take& take) {
    std::error_code failed;
    if (!take.asset_root.empty() && !std::filesystem::is_directory(take.asset_root, failed)) {
        throw UsageError(fmt::format("there is no folder '{}'", take.asset_root.string()), "--asset-root",
                         "name a folder in which the files lie that the scene names");
    }
    LoadedScene loaded{.scene = anim::load(take.scene_file, take.asset_root), .variant = {}};
    if (take.variant.empty()) return loaded;
    try {
        loaded.variant = anim::choose_variant(loaded.scene, take.variant);
    } catch (const Error& error) {
        throw UsageError(error.what(), "");
    }
    anim::show_variant(loaded.scene, *loaded.variant);
    return loaded;
}

anim::Clip choose_clip(const anim::Scene& scene, const Take& take) {
    try {
        return anim::choose_clip(scene, take.animation, take.scene);
    } catch (const Error& error) {
        throw UsageError(error.what(), "");
    }
}

void check_camera(const anim::Scene& scene, const anim::Clip& clip, std::string_view choice) {
    try {
        (void)engine::choose_camera(scene, clip, choice);
    } catch (const Error& error) {
        throw UsageError(error.what(), "");
    }
}

std::vector<Frame> choose_frames(const Take& take, const anim::Scene& scene, const anim::Clip& clip,
                                 const FramePattern& output) {
    const std::vector<Frame> frames =
        take.frames ? with_last(*take.frames, clip.duration_s, take.rate) : whole_clip(take, scene, clip);
    check_numbered(frames.size(), output);
    return frames;
}

void check_numbered(const Take& take, const FramePattern& output) {
    if (take.frames) check_numbered(take.frames->size(), output);
}

std::string describe(const anim::Warning& warning) {
    return warning.where.empty() ? warning.text : fmt::format("{}: {}", warning.where, warning.text);
}

std::string describe(const anim::Scene& scene, const anim::Clip& clip) {
    if (clip.animations.empty()) return "no animation";
    if (clip.animations.size() > 1) {
        return fmt::format("{} animations together, {:.4g} s", clip.animations.size(), clip.duration_s);
    }
    const anim::Index number = clip.animations.front();
    const std::string& name = scene.animations[number].name;
    const std::string label =
        name.empty() ? fmt::format("animation {}", number) : fmt::format("animation '{}'", name);
    return fmt::format("{}, {:.4g} s", label, clip.duration_s);
}

}  // namespace gridreel::sequences
