#pragma once
// How much memory one file may ask for.

#include "anim/gltf/place.h"

#include <cstddef>

namespace gridreel::anim::gltf {

/// A small file can describe a huge scene: accessors of zeros, many primitives sharing one accessor, many
/// images sharing one buffer view, objects that are empty. What is decoded may reach 512 MiB plus 128 times
/// the bytes read, and no more.
class Budget {
public:
    void add_bytes_read(std::size_t bytes) { left_ += 128 * bytes; }

    /// To be called before memory is allocated.
    /// @throws Error at `place` when the file asks for more than it may
    void spend(std::size_t bytes, const Place& place) {
        if (bytes > left_)
            place.refuse("decoding this takes more memory than a file of this size may ask for",
                         "split the model, or check the counts that it states");
        left_ -= bytes;
    }

    /// What may still be spent.
    [[nodiscard]] std::size_t left() const { return left_; }

private:
    std::size_t left_ = std::size_t{512} << 20;
};

}  // namespace gridreel::anim::gltf
