#pragma once
// What is in a scene file, for people and scripts.

#include "anim/clip_bounds.h"
#include "anim/scene.h"
#include "engine/frame_renderer.h"
#include "sequences/memory_estimate.h"
#include "sequences/take.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gridreel::sequences {

struct AnimationInfo {
    std::string name;
    double duration_s = 0.0;  ///< its last key
    Frame last_frame = 0;     ///< at the rate asked for; the first is 0
    bool plays = false;       ///< in the clip that was chosen
};

/// A camera or light where a node places it.
struct PlacedInfo {
    std::string node;
    std::string name;
    std::string kind;  ///< perspective, orthographic; directional, point, spot
};

struct SceneInfo {
    std::filesystem::path file;
    std::string sha256;
    FrameRate rate;
    std::size_t scenes = 0;
    std::size_t scene = 0;  ///< the one described
    std::vector<AnimationInfo> animations;
    double duration_s = 0.0;  ///< of the clip
    Frame last_frame = 0;
    std::vector<PlacedInfo> cameras;  ///< in the order of their numbers for --camera
    std::vector<PlacedInfo> lights;
    std::size_t moving_triangles = 0;
    std::size_t still_triangles = 0;
    std::size_t vertices = 0;
    anim::Box bounds;  ///< over the whole clip, metres
    std::size_t nodes = 0, meshes = 0, skins = 0, morph_targets = 0, textures = 0, images = 0;
    std::vector<std::string> materials;
    std::vector<std::string> variants;   ///< in the order of their numbers for --variant
    std::optional<anim::Index> variant;  ///< the one shown; absent: the materials' own
    std::vector<std::string> extensions_used;
    std::vector<std::string> extensions_required;
    std::vector<std::string> extensions_supported;  ///< of those used
    std::vector<anim::Warning> warnings;
    std::vector<std::string> notes;   ///< what a render would say besides
    engine::RenderSettings settings;  ///< that `memory` is for: the defaults
    int threads = 1;                  ///< likewise: all that this process may use
    MemoryEstimate memory;
};

/// Loads the file and looks at the clip chosen; `take.frames` does not matter.
/// @throws UsageError when animation, scene or variant do not exist
/// @throws Error when it cannot be rendered
[[nodiscard]] SceneInfo inspect(const Take& take);

/// A page of text, every line ended.
[[nodiscard]] std::string to_text(const SceneInfo& info);

/// One JSON object, schema `gridreel.info/1`, indented, ended by a newline.
[[nodiscard]] std::string to_json_text(const SceneInfo& info);

}  // namespace gridreel::sequences
