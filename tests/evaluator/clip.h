#pragma once
// What plays: the animated properties of some animations, by their JSON pointers.

#include "file.h"
#include "keyframes.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gridreel::evaluator {

struct Channel {
    /// The property as the glTF 2.0 Asset Object Model names it, also where the file says "node" and "path":
    /// "/nodes/3/translation", "/nodes/0/weights/1", …
    std::string pointer;
    Keyframes keys;
};

struct Clip {
    std::vector<Channel> channels;
    double end_s = 0.0;  ///< the last key
};

/// The animations with these numbers, together.
[[nodiscard]] Clip play(const File& file, const std::vector<std::size_t>& animations);

/// All animations when no two of them animate the same property, else the first, as `--animation auto` does.
/// The weights of a node are one property.
[[nodiscard]] std::vector<std::size_t> animations_by_default(const File& file);

}  // namespace gridreel::evaluator
