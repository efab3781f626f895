#pragma once
// Triangles of a march that wait to be intersected.

#include "traversal/ray_batch.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// Triangles that wait, and which have waited before: a small direct-mapped mailbox.
class Candidates {
public:
    static constexpr std::size_t capacity = 1024;
    static constexpr std::size_t mailbox_size = 1024;  ///< a power of two: % is a mask

    /// @param remembers  whether there is a mailbox
    void clear(bool remembers) {
        remembers_ = remembers;
        count_ = 0;
        forget();
    }

    /// Lets every triangle be a candidate again.
    void forget() { met_.fill(no_triangle); }

    /// Adds a triangle unless the march met it lately. Forgetful: a triangle may be added again. Whether it
    /// is added is as good as random, so it is never branched upon.
    void add(std::uint32_t triangle) {
        std::uint32_t& entry = met_[triangle % met_.size()];
        triangles_[count_] = triangle;
        count_ += static_cast<std::size_t>(entry != triangle) | static_cast<std::size_t>(!remembers_);
        entry = triangle;
    }

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const std::uint32_t* data() const { return triangles_.data(); }
    void drop_all() { count_ = 0; }

private:
    std::size_t count_ = 0;
    bool remembers_ = true;
    std::array<std::uint32_t, mailbox_size> met_;
    std::array<std::uint32_t, capacity> triangles_;
};

}  // namespace gridreel::traversal
