#pragma once
// Coherent grid traversal of one packet.

#include "traversal/grid_scene.h"
#include "traversal/packet.h"
#include "traversal/tracer.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace gridreel::traversal {

/// Triangles of a march that wait to be intersected, and which have waited before.
class Candidates {
public:
    static constexpr std::size_t capacity = 1024;

    void clear() {
        count_ = 0;
        forget();
    }

    /// Lets every triangle be a candidate again.
    void forget() { met_.fill(no_triangle); }

    /// Adds a triangle unless the march met it lately. Forgetful: a triangle may be added again.
    void add(std::uint32_t triangle) {
        std::uint32_t& entry = met_[triangle % met_.size()];
        if (entry == triangle) return;
        entry = triangle;
        triangles_[count_++] = triangle;
    }

    [[nodiscard]] bool full() const { return count_ == capacity; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const std::uint32_t* data() const { return triangles_.data(); }
    void drop_all() { count_ = 0; }

private:
    std::size_t count_ = 0;
    std::array<std::uint32_t, 1024> met_{};
    std::array<std::uint32_t, capacity> triangles_{};
};

/// Finds the closest hit of every ray of the packet (Wald et al. 2006, section 3): walks the grid slice by
/// slice along K, collects the triangles of the cells that the packet's frustum overlaps, and culls them
/// against the frustum and against each block before any ray is tested.
/// Only `rays` of the report stays zero.
TraceReport march_closest(const GridScene& scene, Packet& packet, Candidates& candidates);

/// The same until every ray is blocked by something: such rays get depth -1.
TraceReport march_any(const GridScene& scene, Packet& packet, Candidates& candidates);

}  // namespace gridreel::traversal
