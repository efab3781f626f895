#pragma once
// Which frames of which animation of a file: asked for, and found.

#include "anim/clip.h"
#include "anim/scene.h"
#include "sequences/frame_list.h"
#include "sequences/frame_pattern.h"
#include "sequences/frame_rate.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gridreel::sequences {

/// What to play, as asked for.
struct Take {
    std::filesystem::path scene_file;
    std::filesystem::path asset_root{};  ///< as `anim::load` takes it
    std::string animation = "auto";      ///< as `anim::choose_clip` takes it
    std::optional<anim::Index> scene;    ///< of the file; absent: its default
    std::string variant;                 ///< as `anim::choose_variant` takes it; empty: the materials' own
    FrameRate rate;
    std::optional<std::vector<Frame>> frames;  ///< absent: the whole clip, last key included
    bool loop = false;  ///< the whole clip is without its last frame when that repeats the first
};

/// A file, and which of its variants its materials show.
struct LoadedScene {
    anim::Scene scene;
    std::optional<anim::Index> variant;  ///< absent: none was asked for
};

/// `anim::load` of the take's file in the variant asked for; one that the file does not have is the caller's
/// mistake, as is an asset root that is no folder.
/// @throws UsageError, Error
[[nodiscard]] LoadedScene load_scene(const Take& take);

/// `anim::choose_clip`, but a name that the file does not have is the caller's mistake.
/// @throws UsageError
[[nodiscard]] anim::Clip choose_clip(const anim::Scene& scene, const Take& take);

/// Refuses a camera that the file does not have before anything is made for it.
/// @param choice  as `engine::RenderSettings::camera`
/// @throws UsageError
void check_camera(const anim::Scene& scene, const anim::Clip& clip, std::string_view choice);

/// The frames asked for, `clip_end` among them being the clip's last, each once; or 0 to the clip's last.
/// @throws UsageError when there are several and `output` has no place for a number, or when the whole
///         clip has more than `max_frames`, or its last more than `max_frame_number`
[[nodiscard]] std::vector<Frame> choose_frames(const Take& take, const anim::Scene& scene,
                                               const anim::Clip& clip, const FramePattern& output);

/// The same rule before the file is loaded, as far as the frames are known.
void check_numbered(const Take& take, const FramePattern& output);

/// Where in the file and what, for people; what concerns the whole file has no place.
[[nodiscard]] std::string describe(const anim::Warning& warning);

/// What a clip plays, for people: `animation "Walk", 2.5 s`; `all 3 animations, 4 s`; `no animation`.
[[nodiscard]] std::string describe(const anim::Scene& scene, const anim::Clip& clip);

}  // namespace gridreel::sequences
