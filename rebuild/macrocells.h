#pragma once
// Which parts of a grid are empty.

#include "rebuild/buffer.h"
#include "rebuild/grid.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>

namespace gridreel::rebuild {

/// Cubes of cells of the top grid, and whether any of their cells holds anything (Wald et al. 2006, section
/// 4.3). Keeps its memory.
class Macrocells {
public:
    static constexpr int side = 6;  ///< in cells

    /// Runs in the calling thread's TBB arena.
    void rebuild(const Grid& grid);

    /// @param first, last  cells of the top grid, per axis, both included
    [[nodiscard]] bool any_in(const glm::ivec3& first, const glm::ivec3& last) const;

    [[nodiscard]] std::size_t bytes() const { return occupied_.bytes(); }

private:
    [[nodiscard]] std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(resolution_.y) +
                static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(resolution_.x) +
               static_cast<std::size_t>(x);
    }

    glm::ivec3 resolution_{0};  ///< in cubes
    Buffer<std::uint8_t> occupied_;
};

}  // namespace gridreel::rebuild
