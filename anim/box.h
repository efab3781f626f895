#pragma once
// Axis-aligned boxes around whatever is finite.

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>

namespace gridreel::anim {

/// An axis-aligned box; the default is empty and grows by `extend`.
struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    /// Grows to hold `point`, unless that is not finite.
    void extend(const glm::vec3& point) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) return;
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void extend(const Box& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }

    friend bool operator==(const Box&, const Box&) = default;
};

}  // namespace gridreel::anim
