#pragma once
// The smallest scene that moves.

#include <filesystem>

namespace gridreel::test {

/// Writes `tiny.gltf` and its buffer: a right triangle with corners (0,0,0), (1,0,0), (0,1,0) whose node
/// moves along x from 0 to 2 m during one second (animation "Slide"), beside a second node "Still" with the
/// same triangle at z = -1. Camera node "Cam" at (1, 0.5, 5) looks down -z, 0.8 rad high, aspect 2.
/// @return the scene file
std::filesystem::path write_tiny_scene(const std::filesystem::path& folder);

}  // namespace gridreel::test
