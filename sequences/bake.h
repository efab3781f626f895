#pragma once
// The deformed triangles of each frame as files.

#include "sequences/frame_pattern.h"
#include "sequences/take.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace gridreel::sequences {

struct BakeJob {
    Take take;
    FramePattern output;  ///< `.ply`
    bool normals = false;
    std::string camera = "auto";  ///< as `engine::RenderSettings::camera`
    std::int32_t width = 1280;    ///< of the picture whose camera is written down, pixels
    std::optional<std::int32_t> height = 720;
};

/// Told how a bake goes.
struct BakeReports {
    std::function<void(std::string_view)> warning;  ///< of the scene, as soon as it is loaded
    std::function<void(std::string_view)> note;     ///< what the bake decided on its own

    /// After each frame: its number, its file, frames done, frames in all.
    std::function<void(Frame, const std::filesystem::path&, std::size_t, std::size_t)> frame_done;
};

struct BakeResult {
    std::size_t frames = 0;         ///< written
    std::filesystem::path cameras;  ///< the camera file
    bool interrupted = false;
};

/// Where the camera of every frame is written: `SCENE.cameras.json` beside the meshes.
[[nodiscard]] std::filesystem::path camera_file(const BakeJob& job);

/// Writes one PLY per frame, world space, in the order `anim::lay_out` gives; then the camera file
/// (camera_file.h), in which frames that the same bake wrote earlier stay. Normals are those of the file's
/// vertices, zero where it has none.
///
/// @throws UsageError, OutputError, Error as `run_job` does
BakeResult bake(const BakeJob& job, const BakeReports& reports, const std::atomic<bool>& stop);

}  // namespace gridreel::sequences
