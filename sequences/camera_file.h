#pragma once
// The camera of every baked frame in one file, which parts of a sequence fill bake by bake.

#include "anim/scene.h"
#include "engine/camera.h"
#include "sequences/frame_list.h"
#include "sequences/frame_rate.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gridreel::sequences {

/// What the frames of a camera file have in common; frames that differ in it belong to another bake.
struct CameraFileHead {
    std::string camera;   ///< name of its node; "fit" without one
    double aspect = 1.0;  ///< of the picture, width / height
    std::string scene_sha256;
    anim::Index scene = 0;                ///< of the file
    std::vector<anim::Index> animations;  ///< that play
    FrameRate rate;
};

struct BakedView {
    Frame frame = 0;
    double time_s = 0.0;
    engine::View view;
};

/// Writes `{"schema": "gridreel.cameras/1", "camera", "scene_sha256", "scene", "animations", "fps", "aspect",
/// "frames": [{"frame", "time_s", "kind", "eye", "forward", "up", "fov_y_rad" (perspective) or
/// "half_height_m" (orthographic), "aspect"}, …]}`, frames ascending.
///
/// Frames that stand in `file` already stay, unless they are among `views`. A file of another bake, or one
/// that is no camera file, is replaced as a whole. The file appears whole or not at all, but of two programs
/// that write it at the same time the later one may lose the other's frames.
///
/// @return why what stood in the file was dropped, a sentence; empty when nothing was
/// @throws OutputError
[[nodiscard]] std::string write_camera_file(const std::filesystem::path& file, const CameraFileHead& head,
                                            std::span<const BakedView> views);

}  // namespace gridreel::sequences
