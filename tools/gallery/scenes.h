#pragma once
// The bundled scenes, and those that only measurements need.

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

/// Small triangles drift through a cube, each its own way: a morph target.
[[nodiscard]] Document make_soup(std::size_t triangles);

/// Needles, 120 times as long as wide, spin about their middles: morph targets, cubic splines.
[[nodiscard]] Document make_needles(std::size_t triangles);

/// A hollow ball breaks into pieces that fly apart: node animation.
[[nodiscard]] Document make_exploding(std::size_t triangles);

/// A finely meshed figure walks among coarse trees in the wind: skin, node animation, a camera that follows.
[[nodiscard]] Document make_forest(std::size_t triangles);

/// In sequences/gallery, or made when something is measured.
enum class Place { bundled, on_demand };

/// How a scene is asked for. Each has a smallest size (a few dozen triangles); from about 2000 triangles
/// on, what comes out is within 2 % of what was asked for.
struct SceneMaker {
    std::string_view name;
    std::string_view summary;
    Document (*make)(std::size_t triangles);
    std::size_t usual_triangles;  ///< of the bundled file, or when nothing else is asked for
    Place place;
};

inline constexpr std::array<SceneMaker, 8> scene_makers{{
    {"marbles", "rigid spheres fall into a bowl", make_marbles, 56'000, Place::bundled},
    {"walker", "a skinned figure walks", make_walker, 15'000, Place::bundled},
    {"sheet", "a curtain in the wind, by morph targets", make_sheet, 7'000, Place::bundled},
    {"stadium", "a small rippling knot in a huge bowl", make_stadium, 7'200, Place::bundled},
    {"soup", "small triangles drift, each its own way", make_soup, 80'000, Place::on_demand},
    {"needles", "long thin triangles spin", make_needles, 50'000, Place::on_demand},
    {"exploding", "a dense shell breaks into pieces", make_exploding, 250'000, Place::on_demand},
    {"forest", "a fine figure among coarse trees", make_forest, 174'000, Place::on_demand},
}};

}  // namespace gridreel::gallery
