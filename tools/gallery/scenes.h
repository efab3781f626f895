#pragma once
// The bundled scenes.

#include "tools/gallery/document.h"

#include <array>
#include <string_view>

namespace gridreel::gallery {

/// Rigid marbles fall into a bowl: node animation (translation and rotation keys).
[[nodiscard]] Document make_marbles(std::size_t triangles);

/// A figure walks past posts: skin, joints, a camera that follows.
[[nodiscard]] Document make_walker(std::size_t triangles);

/// A curtain in the wind: morph targets, weights as cubic splines.
[[nodiscard]] Document make_sheet(std::size_t triangles);

/// A small rippling knot in the middle of a huge bowl: dense and coarse in one scene.
[[nodiscard]] Document make_stadium(std::size_t triangles);

/// How a scene is asked for. Each has a smallest size (a few dozen triangles); from about 2000 triangles
/// on, what comes out is within 2 % of what was asked for.
struct SceneMaker {
    std::string_view name;
    std::string_view summary;
    Document (*make)(std::size_t triangles);
    std::size_t bundled_triangles;  ///< asked for when the bundled file is written
};

inline constexpr std::array<SceneMaker, 4> scene_makers{{
    {"marbles", "rigid spheres fall into a bowl", make_marbles, 56'000},
    {"walker", "a skinned figure walks", make_walker, 15'000},
    {"sheet", "a curtain in the wind, by morph targets", make_sheet, 7'000},
    {"stadium", "a small rippling knot in a huge bowl", make_stadium, 7'200},
}};

}  // namespace gridreel::gallery
