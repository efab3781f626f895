#pragma once
// Random animated scenes: whatever can be combined is.

#include "anim/scene.h"

#include <cstdint>

namespace gridreel::anim::testing {

struct RandomSceneOptions {
    std::size_t vertices_per_part = 40;
    double offset = 0.0;  ///< how far off the world's origin everything stands, metres
};

/// Trees of nodes, some mirrored, sheared or in no scene; rigid, morphing and skinned parts with normals
/// and tangents; animations of every path and interpolation within 0 to 2 s. The same for the same seed.
[[nodiscard]] Scene random_scene(std::uint32_t seed, const RandomSceneOptions& options = {});

}  // namespace gridreel::anim::testing
