#pragma once
// Many copies of one character, no two at the same moment of its clip.

#include <cstddef>
#include <filesystem>
#include <string>

namespace gridreel::gallery {

struct Crowd {
    std::string glb{};  ///< the bytes of the file
    std::size_t triangles = 0;
};

/// Copies the character of a .glb file into rows and columns, with a camera above the front row and two
/// lights in place of the file's own. Meshes, materials and images are shared; every copy has its own
/// skeleton, and plays the clip that gridreel would play in a loop, from its own phase.
///
/// @param count  >= 1
/// @throws Error when the file is not a sound .glb, has no skin or no animation, or refers to other files
[[nodiscard]] Crowd make_crowd(const std::filesystem::path& character, std::size_t count);

}  // namespace gridreel::gallery
