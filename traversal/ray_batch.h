#pragma once
// The rays of one wave and what became of them, as structures of arrays.

#include "rebuild/buffer.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace gridreel::traversal {

/// How neighbouring rays of a batch relate, for tracers that form packets.
enum class RayOrder {
    arbitrary,  ///< nothing is known: sort before forming packets
    coherent,  ///< consecutive rays are neighbours (a Morton walk over the picture): cut packets as they come
};

/// Rays of one wave; incoherent if they have neither origin nor direction in common. Points are `origin + t *
/// direction`, t in (t_min, t_max). Directions need not be unit length; t is in units of the direction's
/// length. A ray with a zero or non-finite direction, an origin that is not traceable
/// (rebuild/triangle_view.h), or t_min >= t_max hits nothing.
struct RayBatch {
    std::optional<glm::vec3> common_origin;     ///< set: every ray starts here and `origin` is empty
    std::optional<glm::vec3> common_direction;  ///< set: rays are parallel and `direction` is empty
    RayOrder order = RayOrder::arbitrary;
    std::array<rebuild::Buffer<float>, 3> origin;     ///< x, y, z; empty when there is a common origin
    std::array<rebuild::Buffer<float>, 3> direction;  ///< x, y, z; empty when there is a common direction
    rebuild::Buffer<float> t_min;                     ///< >= 0
    rebuild::Buffer<float> t_max;
    /// Empty, or for every ray a triangle that it is known to meet, whose hit it goes on behind: only hits
    /// that come later count, in the order of distance and then of index. t_min is not looked at.
    rebuild::Buffer<std::uint32_t> after_triangle;

    [[nodiscard]] std::size_t size() const { return t_max.size(); }

    /// Makes room for `count` rays, contents unspecified, that go on behind nothing. Allocates only when it
    /// outgrows all earlier batches.
    void resize(std::size_t count, std::optional<glm::vec3> shared_origin, RayOrder ray_order);

    /// The same for rays that have their direction in common, but not their origin.
    void resize_parallel(std::size_t count, const glm::vec3& shared_direction, RayOrder ray_order);

    [[nodiscard]] glm::vec3 origin_of(std::size_t ray) const;
    [[nodiscard]] glm::vec3 direction_of(std::size_t ray) const;
    void set_origin(std::size_t ray, const glm::vec3& value);     ///< only without a common origin
    void set_direction(std::size_t ray, const glm::vec3& value);  ///< only without a common direction

private:
    void resize_arrays(std::size_t count);
};

inline constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

/// Closest hit of every ray: its t (infinity on a miss) and triangle (`no_triangle` on a miss).
/// Of several triangles at the same t the lowest index wins.
struct HitBatch {
    rebuild::Buffer<float> t;
    rebuild::Buffer<std::uint32_t> triangle;

    void resize(std::size_t count);
};

/// 1 for every ray that something blocks, else 0.
using OcclusionBatch = rebuild::Buffer<std::uint8_t>;

/// In an `OcclusionBatch` that is still being filled: not yet known.
inline constexpr std::uint8_t undecided = 2;

}  // namespace gridreel::traversal
