#pragma once
// What `gridreel render` is asked to do. Plain data.

#include "engine/frame_renderer.h"
#include "sequences/frame_pattern.h"
#include "sequences/image_settings.h"
#include "sequences/take.h"

#include <filesystem>
#include <string_view>

namespace gridreel::sequences {

struct Job {
    Take take;
    FramePattern output;
    ImageSettings image;  ///< its format goes with `output`'s extension
    std::filesystem::path log;
    engine::RenderSettings render;
    int threads = 1;          ///< how many the caller's arena has: for the log and for compression
    bool keep_going = false;  ///< go on with the next frame after one that failed
};

/// `frames/SCENE.####EXTENSION`, where output goes by default.
[[nodiscard]] FramePattern default_output(const std::filesystem::path& scene_file,
                                          std::string_view extension);

/// The log beside the frames: `out/fox.####.exr` has `out/fox.jsonl`; without a name of its own, the scene's.
[[nodiscard]] std::filesystem::path default_log(const FramePattern& output,
                                                const std::filesystem::path& scene_file);

}  // namespace gridreel::sequences
